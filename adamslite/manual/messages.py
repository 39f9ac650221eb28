"""Pages of the messages about a deck and of the outcomes of a run."""

from __future__ import annotations

from adamslite.language.messages import MESSAGES
from adamslite.language.messages.entry import Message
from adamslite.manual.markdown import HEAD, table
from adamslite.results.outcomes import Outcome

INTRO = """# Messages

Every message about a deck, each with the smallest deck that causes it: statements added to a
correct deck, or a whole deck where they begin with a title. Words in braces are filled in.
"""
OUTCOMES_INTRO = """## How a run can end

The summary and the result file contain the name of the outcome; the message contains its sentence.
"""


def messages() -> str:
    """The page of all messages and outcomes: docs/reference/messages.md."""
    entries = (message(code, each) for code, each in MESSAGES.items())
    outcomes = table(("outcome", "sentence"), [(f"`{o.name}`", o.value) for o in Outcome])
    return "\n".join([HEAD, INTRO, *entries, OUTCOMES_INTRO, outcomes])


def message(code: str, each: Message) -> str:
    """One message: sentence, hint and example."""
    text = f"{each.severity}: {each.sentence}"
    if each.hint:
        text += f"  \nhint: {each.hint}"
    examples = each.broken or each.commands
    if not examples:  # it takes too many lines
        return f"## `{code}`\n\n{text}\n"
    example = each.deck + examples[0].rstrip("\n")
    bound = f'\n\nwith `--user "{each.user[0]}"`' if each.user else ""
    return f"## `{code}`\n\n{text}\n\n```\n{example}\n```{bound}\n"
