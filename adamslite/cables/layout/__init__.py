"""Where the cable lies at the start: straight spans between wheels, arcs on them, spans that sag.

Read geometry first: a FreeSpan between two tangent points is what all that follows goes by.
"""
