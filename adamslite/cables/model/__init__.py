"""What a cable will do, estimated without solving a deck, and the model that this needs.

Read demand first: travel, speeds and masses become a Demand, and each effect asks for its sections.
Then model_choice decides: level, form, sections, integrator.
"""
