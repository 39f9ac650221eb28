"""From text to syntax trees: tokens, statements and the forms of the grammar.

::

    text --tokens.scan--> tokens --lines.join--> statements --forms.statement_form--> items
                                                           --forms.expression_form--> tree
"""
