"""Texts that no author writes are read as fast as others, and few messages say what is wrong.

What grows is counted: bytes, comparisons, messages; never seconds.
"""

import gc
import tracemalloc
from random import Random

import pytest

import adamslite as al
from adamslite.kernels import collecting, columns
from adamslite.language import likeness
from adamslite.language.diagnostics import MOST, QUOTED, LeftOut, limited
from adamslite.language.likeness import did_you_mean
from adamslite.language.messages import MESSAGES
from adamslite.reading import resolver
from adamslite.syntax import forms, lines, tokens
from adamslite.syntax.lines import join
from adamslite.syntax.tokens import scan
from adamslite.syntax.typeset import Plain
from benchmarks.hostile_texts import BODIES, KINDS

DECK = f"{BODIES}! what follows is wrong\n"
DEGREES = "PART=2, QP=1D,0,0"
"""Arguments of a MARKER with a warning."""


def told(text):
    """Everything there is to say about a text."""
    return al.check(text + "\n")


def most_memory(kind, size):
    """Bytes that checking so much hostile text in one line takes at most."""
    text = KINDS[kind].text(size, many=False)
    gc.collect()
    tracemalloc.start()
    try:
        told(text)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


# ---- few messages --------------------------------------------------------------------------------


def test_two_hundred_messages_are_kept_and_the_last_one_counts_the_others():
    found = told(DECK + "ZZZ/1\n" * 1000)
    assert len(found) == MOST + 1 and isinstance(found[-1], LeftOut)
    assert [each.span.line for each in found[:-1]] == list(range(7, 7 + MOST))
    assert found[-1].numbers == (1000 - MOST, 0, 0) and found[-1].is_error
    assert found[-1].message.endswith(f": {1000 - MOST} errors")
    assert found.counts == "1000 errors, 0 warnings"
    assert found[-1].message == MESSAGES["more-messages"].sentence.format(
        most=MOST, listed="800 errors"
    )


def test_an_error_is_kept_behind_any_number_of_warnings():
    found = told(DECK + "".join(f"MARKER/{n}, {DEGREES}\n" for n in range(3, 800)) + "ZZZ/1\n")
    assert "unknown-statement" in [each.code for each in found]
    assert len(found) == MOST + 1 and found[-1].severity == "warning"


def test_what_comments_ignore_takes_the_place_of_nothing():
    """300 warnings that the author has judged stand before the one that he has not."""
    code = "degrees-of-no-angle"
    judged = "".join(f"MARKER/{n}, {DEGREES} ! adamslite: ignore {code}\n" for n in range(3, 303))
    deck = f"{DECK}{judged}MARKER/999, {DEGREES}\n"
    lines = [each.span.line for each in told(deck) if each.code == code]
    assert lines == [deck.count("\n")]


def test_messages_are_left_out_once_and_counted_together():
    one, other = (told(DECK + "ZZZ/1\n" * n) for n in (300, 400))
    both = limited([*one, *other])
    assert len(both) == MOST + 1 and both[-1].numbers == (500, 0, 0)


def test_comments_that_ignore_nothing_are_counted_too():
    text = "".join(f"MARKER/{n}, PART=2 ! adamslite: ignore wrong-{n}\n" for n in range(3, 503))
    found = told(DECK + text)
    assert found[-1].message.endswith(f": {found[-1].numbers[2]} notes")
    assert sum(each.code == "ignores-nothing" for each in found) + found[-1].numbers[2] >= 500


def test_a_text_of_mistakes_is_not_read_to_its_end(monkeypatch):
    """What is behind is not read, and nothing is said to be missing for that."""
    monkeypatch.setattr("adamslite.language.messages.MOST_COUNTED", 100)
    wrong = "ZZZ/1\n" * 1000
    found = told(f"{DECK}{wrong}PART/7, MASS=-1\n")
    assert found[-1].last_line == 6 + MOST + 100
    assert f"reading ended in line {6 + MOST + 100} " in found[-1].render()
    assert found.counts == f"{MOST + 100} errors, 0 warnings"
    assert found == limited([*found, *found[:0]])
    behind = told(f"hostile\n{wrong}{DECK}")
    assert {each.code for each in behind} == {"unknown-statement", "more-messages"}


def test_reading_goes_on_where_all_mistakes_are_counted():
    assert told(DECK + "ZZZ/1\n" * 1000)[-1].last_line == 0


# ---- short messages ------------------------------------------------------------------------------


@pytest.mark.parametrize("before", [0, 1, 79, 80, 81, 120, 199, 200, 5000])
@pytest.mark.parametrize("behind", [0, 1, 119, 120, 121, 5000])
def test_a_long_line_is_quoted_round_the_place(before, behind):
    line = f"PART/3, {' ' * before}ZZZ=1{' ' * behind}!"
    found = next(each for each in told(DECK + line) if each.code == "unknown-argument")
    assert len(found.source_line) <= QUOTED
    assert len(found.source_line) == min(QUOTED, len(line))
    start = found.span.column - found.source_column
    assert found.source_line[start : start + 3] == "ZZZ"
    quoted, carets = found.render().splitlines()[1:3]
    assert quoted[carets.index("^") :].startswith("ZZZ") and carets.count("^") == 3


def test_a_word_of_any_length_is_cut():
    found = told(DECK + f"{'A' * 100_000}/1\n{'B' * 100_000}/2, {'C' * 100_000}=1")
    assert all(len(each.render()) < 2500 for each in found)


# ---- little memory -------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind",
    ["unknown arguments", "unknown statements", "exclamation marks", "UTF-16", "the same argument"],
)
def test_memory_grows_as_the_text_does(kind):
    most_memory(kind, 4_000)  # imports
    small, large = most_memory(kind, 40_000), most_memory(kind, 160_000)
    assert large < 6 * small


def test_blank_and_comment_lines_take_no_memory_of_their_own():
    text = "hostile\n" + "!\n" * 100_000 + "PART/1, GROUND\n"
    tracemalloc.start()
    try:
        al.check(text)
        assert tracemalloc.get_traced_memory()[1] < 60 * len(text)
    finally:
        tracemalloc.stop()


# ---- few guesses ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "known, line", [("MARKER/some{0}, PART=2", "REQUEST/{0}, F2=DX(other{0}, 1)"),
                    ("POINT_MASS/some{0}, MASS=1", "MREQUEST/{0}, DISPLACEMENT, PARTS=other{0}")],
)  # fmt: skip
def test_guesses_about_one_text_are_bounded(monkeypatch, known, line):
    made = []
    monkeypatch.setattr(
        likeness, "did_you_mean", lambda word, listed: made.append(len(listed)) or ""
    )
    names = "".join(f"{known.format(n)}\n" for n in range(900))
    told(DECK + names + "".join(f"{line.format(n)}\n" for n in range(1, 900)))
    assert 0 < sum(made) < likeness.BUDGET + 1000


def test_one_wrong_letter_is_found_among_many_names():
    names = [f"left_bogie_wheel_{n}" for n in range(20_000)]
    for word in ("left_bogie_wheel_777x", "left_bogie_wheel_x77", "left_bogie_hweel_777"):
        assert "LEFT_BOGIE_WHEEL_" in did_you_mean(word, names)
    assert did_you_mean("right_bogie_777", names) == ""


# ---- one sweep -----------------------------------------------------------------------------------

WORDS = (
    *'",\\()[]=/:;*&!+-.', "**", "* *", "1D+3", "90D", "1E-5", ".5", "1.", "MARKER", "a.b.c",
    "\n", "\n,", "\n ! more\n", " ", "\t", '"quoted, text"', "\\alpha", "\\Delta  x", "\u0394",
    " " * 70,
)  # fmt: skip


def tokens_of(text):
    """All tokens, from however many stretches."""
    return [token for stretch in scan(text) for token in stretch]


def test_tokens_do_not_depend_on_where_a_text_is_cut(monkeypatch):
    """Nor do the statements, which look at the tokens behind their last one."""
    random = Random(19)
    for _ in range(1500):
        text = "".join(random.choices(WORDS, k=random.randint(1, 150)))
        whole, joined = tokens_of(text), [*join(scan(text), ampersand=True)]
        with monkeypatch.context() as cut:
            cut.setattr(tokens, "STRETCH", random.choice([8, 20, 90]))
            cut.setattr(lines, "MANY", random.choice([9, 20, 512]))
            assert tokens_of(text) == whole
            pieces = [*join(scan(text), ampersand=True)]
        assert [([*each.tokens], each.name) for each in pieces] == [
            ([*each.tokens], each.name) for each in joined
        ]


@pytest.mark.parametrize("piece", [",", "(", "1,", "=a", '"', "a\\", "\\text{a}, "])
def test_a_line_of_any_length_is_scanned_in_stretches(piece):
    """No stretch grows with the line."""
    lengths = [len(stretch) for stretch in scan(piece * (1_000_000 // len(piece)))]
    assert max(lengths) <= 4 * tokens.STRETCH and len(lengths) > 3


def test_columns_of_tokens_are_as_a_list_of_them():
    listed = tokens_of("MARKER/1, PART=2, QP=1,2,3\n" * 30)
    columns = tokens.Lexemes(listed[:99])
    for many in (3, len(listed)):
        kept = [*columns[:50], listed[0], *columns[50:]]
        columns = tokens.lengthened(tokens.Lexemes(kept[:-1]), [kept[-1]])
        columns.append(listed[many - 1])
        assert [*columns] == [*kept, listed[many - 1]] and len(columns) == len(kept) + 1
        assert columns[-1] == listed[many - 1] and columns[2:5] == kept[2:5]
        assert columns.pop() == listed[many - 1]
    columns.insert(1, listed[2])
    columns[0] = listed[3]
    assert columns[:2] == [listed[3], listed[2]]


def test_mathematics_is_looked_for_once():
    """With many signs that would begin it, on one line and on many, and one that ends it at last:
    there, or too late on the next line.
    """
    signs = "\\[" * 40_000
    texts = (
        "$$" * 40_000,
        f"x{signs}\\]",
        f"x{signs}\n\\]",
        "x\\[\n" * 40_000 + "\\]",
        "$a$ " * 20_000,
    )
    for text in texts:
        Counted.looked = 0
        Plain(Counted(text))
        assert Counted.looked < 8 * len(text)


class Counted(str):
    """A text that counts the characters that are searched in it."""

    looked = 0

    def find(self, sub, start=0, end=None):
        at = super().find(sub, start, len(self) if end is None else end)
        Counted.looked += (at if at >= 0 else len(self) if end is None else end) - start
        return at

    def rfind(self, sub, start=0, end=None):
        at = super().rfind(sub, start, end)
        Counted.looked += (len(self) if end is None else end) - max(at, start)
        return at


# ---- long statements -----------------------------------------------------------------------------

ITEMS = (
    "A=1", "FLAG", "7", "1 2 3 4 5 6", "F=IF(TIME: MAX(1,2,3,4,5,6), 2, 3)+1", "F=1+2+3+4+5+6+7",
    "F=SIN(1)+MAX[2, 3]+SIN(3)+A()+DX(1,2)+DX(3,4)",
    "(1, 2, 3, 4, 5, 6)", "((1, (2, 3)), [4 5, (6)], 7, 8)", "A=1 ((((1)))) [2] ()",
)  # fmt: skip
KINDS_OF_TOKENS = (
    "NAME NUMBER PLUS SLASH COLON OTHER COMMA EQUAL BACKSLASH LPAR RPAR LSQB RSQB".split()
)


def random_kinds(random):
    """Kinds of the tokens of a statement with up to two mistakes of form."""
    text = "NAME/" + "".join(
        random.choice(ITEMS) + random.choice([",", ",", ",", "\\", "\\,"])
        for _ in range(random.randint(1, 9))
    )
    kinds = [token[0] for token in tokens_of(text)]
    del kinds[len(kinds) - random.randint(0, 1) :]
    for _ in range(random.randint(0, 2)):
        kinds.insert(random.randrange(len(kinds)), random.choice(KINDS_OF_TOKENS))
    return tuple(kinds)


def test_a_long_statement_is_parsed_by_pieces_as_it_is_as_a_whole(monkeypatch):
    monkeypatch.setattr(forms, "PIECE", 5)
    run, values = forms.runs(4)
    monkeypatch.setattr(forms, "RUN", run)
    monkeypatch.setattr(forms, "VALUES", values)
    random, right = Random(18), 0
    for _ in range(3000):
        kinds = random_kinds(random)
        whole = forms._short_form(kinds)
        pieces = forms._long_form(kinds)
        assert (pieces if isinstance(pieces, forms.Fault) else tuple(pieces)) == whole
        right += not isinstance(whole, forms.Fault)
    assert 500 < right < 2500


def test_the_parser_sees_little_of_a_long_statement(monkeypatch):
    """Of a million values side by side two, of values with commas one piece of them."""
    seen = []
    parse = forms._form
    monkeypatch.setattr(
        forms, "_form", lambda parser, kinds: seen.append(len(kinds)) or parse(parser, kinds)
    )
    forms._short_form.cache_clear()
    head = ("NAME", "SLASH")
    (one,) = forms.statement_form((*head, *("NUMBER",) * 1_000_000))
    assert (one.start, one.end) == (2, 1_000_002)
    items = forms.statement_form((*head, *("NUMBER", "COMMA") * 100_000, "NUMBER"))
    assert len(items) == 100_001 and items[-1].end == 200_003
    assert sum(seen) < 2000


def test_a_marker_with_a_hundred_thousand_values_has_one_message():
    found = told(f"{DECK}MARKER/3, PART=2, QP=0{', 0' * 100_000}")
    assert [(each.code, each.message) for each in found if each.is_error] == [
        ("value-count", "QP takes 3 values and has 100001")
    ]


def test_brackets_inside_each_other_have_one_message():
    found = told(f"{DECK}VARIABLE/1, FUNCTION={'(1+' * 50_000}")
    assert [(each.code, each.span.column) for each in found.errors] == [
        ("too-deep", 22 + 3 * (forms.MOST_OPEN - 1))
    ]


def test_rules_are_not_asked_again_where_nothing_of_it_would_be_kept(monkeypatch):
    asked = []
    monkeypatch.setattr(
        "adamslite.reading.read.further_mistakes", lambda given, *_: asked.append(len(given)) or ()
    )
    told(DECK + "".join(f"MARKER/{n}, PART={n}\n" for n in (*range(10, 400),)))
    told(DECK + "MARKER/10, PART=10\n")
    assert asked == [0, 1]


# ---- long expressions ----------------------------------------------------------------------------

POINT = """POINT_MASS/3, MASS=1, CM=3, QG=1,0,0
MARKER/3, POINT_MASS=3
MARKER/4, PART=1
"""
FORCE = "SFORCE/1, TRANSLATIONAL, I=3, J=4, FUNCTION="


def compiled(text):
    return al.compile_model(al.assemble(al.read(f"{BODIES}{POINT}{text}\n")))


def refused(text):
    """The only message about a deck that is not compiled."""
    with pytest.raises(al.DeckError) as fault:
        compiled(text)
    (only,) = fault.value.errors
    return only


def test_an_expression_has_a_longest_length(monkeypatch):
    monkeypatch.setattr(resolver, "LONGEST", 99)
    assert not told(f"{DECK}VARIABLE/1, FUNCTION=TIME{'+TIME' * 49}").errors
    (only,) = told(f"{DECK}VARIABLE/1, FUNCTION=TIME{'+TIME' * 50}")
    assert only.code == "expression-too-long" and " 101 words" in only.message


def test_variables_that_are_written_out_have_a_largest_size(monkeypatch):
    """Both the force and the VARIABLEs that it is made of are named."""
    monkeypatch.setattr(columns, "LARGEST", 40)
    monkeypatch.setattr("adamslite.kernels.binding.LARGEST", 40)
    chain = "VARIABLE/1, FUNCTION=DM(3,4)\n" + "".join(
        f"VARIABLE/{n + 1}, FUNCTION=VARVAL({n})*VARVAL({n})+1\n" for n in range(1, 9)
    )
    only = refused(f"{chain}{FORCE}VARVAL(9)")
    assert only.code == "expression-too-large" and "40 operations" in only.message
    assert only.message.startswith("VARIABLE/") and "VARIABLE/1, VARIABLE/2" in only.hint


def test_all_expressions_of_a_deck_have_a_largest_size(monkeypatch):
    monkeypatch.setattr(collecting, "MOST_IN_ALL", 60)
    own = "".join(f"VARIABLE/{n}, FUNCTION=DM(3,4)**{n}{'+TIME' * n}\n" for n in range(2, 12))
    only = refused(f"{own}{FORCE}1")
    assert only.code == "deck-too-large" and "60 operations" in only.message


def test_a_chain_of_doubled_variables_grows_as_its_length():
    """Written out as a text V40 has 4**40 words."""
    chain = "VARIABLE/1, FUNCTION=DM(3,4)\n" + "".join(
        f"VARIABLE/{n + 1}, FUNCTION=(VARVAL({n})*VARVAL({n})+VARVAL({n})*VARVAL({n}))/4\n"
        for n in range(1, 40)
    )
    assert compiled(f"{chain}{FORCE}VARVAL(40)").groups


@pytest.mark.parametrize("tower", ["9**9**9**9", "DM(3,4)**9**9**9", "DM(3,4)**1000000"])
def test_towers_of_powers_are_numbers_or_have_none(tower):
    assert compiled(f"{FORCE}{tower}").groups
