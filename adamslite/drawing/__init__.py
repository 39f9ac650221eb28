"""What is drawn of a deck and its results: bodies that move, shapes, joints, lines, channels.

Read scene first: it puts together what every other module finds. Their common ground is drawing;
motion and frames say where bodies are, arrays and decimation how numbers are packed. The room gltf
writes a scene for other programs.
"""
