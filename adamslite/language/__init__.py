"""The definition of the language: statements, arguments, functions, messages.

statement, function, method    what each of them is, and how its module declares it
expression                     resolved nodes; traced are numbers that know where they are from
units, spelling, abbreviations quantities and words
diagnostics                    a message with its place; messages has all sentences
register                       how declarations enter by name
"""
