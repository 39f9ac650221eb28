"""What the description of a cable scene may say, how its TOML becomes a Spec, and its mistakes.

Read vocabulary first: a Spec is a cable and its route of stations. Then spec reads it by the rules
of keys.
"""
