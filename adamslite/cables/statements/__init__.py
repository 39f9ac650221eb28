"""The statements of a deck that each wheel, span, weight, guide and engine of a scene becomes.

Read forms first: it has the four forms of a cable with their equations, which every other module
here writes about. Then span_statements goes along the route.
"""
