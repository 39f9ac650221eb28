"""Messages about the description of a cable, each with a description that causes it."""

from adamslite.cables.description.surroundings_messages import SURROUNDINGS
from adamslite.cables.description.toml_places import Path, Places
from adamslite.language.diagnostics import SEVERITIES, WARNING, Diagnostic, LeftOut
from adamslite.language.likeness import Guesses
from adamslite.language.messages.entry import Message

#: Sizes of numbers whose products of several are numbers as well, in any units.
SMALLEST, LARGEST = 1e-50, 1e50

MESSAGES: dict[str, Message] = SURROUNDINGS | {
    "toml": Message("this is not TOML: {why}", "a key, =, a value; texts in quotes"),
    "unknown-key": Message("there is no key {word} here", "the keys are {known}"),
    "missing-key": Message("{label} needs {word}", "write {word} = ..."),
    "wrong-value": Message("{word} takes {expected}", "it is {text}"),
    "not-positive": Message("{word} has to be positive and is {text}", "SI units: N, kg/m, m, s"),
    "not-a-share": Message(
        "{word} has to be at least 0 and below 1, and is {text}", "0.2 is twenty per cent"
    ),
    "negative": Message("{word} cannot be negative and is {text}", "0, or leave it out"),
    "short-route": Message("a route has two ends and {count} stations", "add [[route]] tables"),
    "wrong-end": Message(
        "a {kind} cannot be {where}",
        "ends: fixed, free, run, mass, body, winch; between them: pulley, winch, mass, body, bend;"
        " on a loop: pulley, winch, bend",
    ),
    "no-such-station": Message(
        "the fall goes to {word}, and no station has that name", "the names are {known}"
    ),
    "in-two-falls": Message(
        "the fall of cable {k} goes to {word} too", "a wheel or hook of its own for each cable"
    ),
    "several-closed": Message(
        "of several cables none is closed", "leave closed out, or one [cable] with its route"
    ),
    "several-falls": Message(
        "with several cables each has a fall of its own", "fall = ... in every [[cable]]"
    ),
    "several-brute": Message(
        "{why}; form brute is written for one cable without [[load]]",
        "no bends, no teeth, leans = true at wheels that move across their cable",
    ),
    "no-such-load": Message("there is no load of the name {word}", "the loads are {known}"),
    "no-load": Message("{label} is on a load, and there is none", "[[load]] with its at and mass"),
    "which-load": Message("{label} is on one of {count} loads", "load = ..., its name"),
    "same-load": Message("load {i} has the name {name} too", "a name for each load"),
    "no-hook": Message("no cable and no hinge holds this load", 'kind = "hook" in [[route]]'),
    "load-point": Message(
        "inertia is missing: a load without it is a point, held at its mass centre, and {why}",
        "inertia = ... in [[load]], in kg m^2",
    ),
    "load-alone": Message(
        "{label} is on a load, which carries and moves it: no {word}", "leave {word} out"
    ),
    "not-shared": Message(
        "how {cables} cables share a load depends on their stiffness, which level 1 leaves out",
        "level = 2 or 3, or auto",
    ),
    "unbalanced": Message(
        "the cables do not hold {name} in balance where it is: {force:.4g} N and {torque:.4g} N m"
        " are left",
        "other places of its hooks or mass centre; statics = true starts at rest where it hangs",
        severity=WARNING,
    ),
    "twice-in-fall": Message(
        "the fall goes to {word} {times} times", "a wheel for each time the cable passes"
    ),
    "not-in-fall": Message(
        "the fall does not go to {label}", "name it in the fall, or leave it out"
    ),
    "same-name": Message("station {i} has the name {name} too", "a name for each station"),
    "no-pitch": Message(
        "{count} stations would be at one place", "pitch = [x, y, z], from one to the next"
    ),
    "too-many-stations": Message(
        "{count} stations; a route may have {most}", "a smaller count, or two cables"
    ),
    "held-grips": Message(
        "a wheel that is held, and on which the cable cannot slip, holds the cable",
        'mu = 0.2, or kind = "fixed"',
    ),
    "held-turns": Message(
        "a wheel that is held stands still on the ground: no {word}", "leave {word} out"
    ),
    "without-mu": Message("{word} is for a wheel on which the cable may slip", "give it a mu"),
    "static-grip": Message(
        "friction that is greater at rest needs the displacement before sliding", "grip = 1e-4"
    ),
    "static-below": Message(
        "mu_static is {static:g}, less than mu = {mu:g}", "friction at rest is not the smaller one"
    ),
    "run-to-run": Message(
        "there is nothing between two long runs", "a pulley or a mass that the cable meets"
    ),
    "drive": Message(
        "a winch needs one of payout, speed, force and torque", 'payout = "0.5*TIME**2"'
    ),
    "law-drives": Message(
        "the {drive} of this winch is kept whatever acts on it: no {word}",
        "leave {word} out, or drive it by torque, or by speed with a motor",
    ),
    "motor-force": Message(
        "a characteristic limits a torque, and this winch has a force", "torque = ... for force"
    ),
    "no-gain": Message(
        "the motor has no gain for the error of its speed", "gain = 1e4, in N m per m/s of the rim"
    ),
    "needless-gain": Message(
        "a gain is for a motor that keeps a speed", "speed = ... for torque, or leave gain out"
    ),
    "floor-where": Message("without gravity nothing lies on a floor", "gravity = [0, -9.81, 0]"),
    "limit-start": Message(
        "the payout starts at 0, outside of the limits {low:.4g} and {high:.4g} m",
        "limit = [-2, 5]: from the place in the route, in is negative",
    ),
    "reel-between": Message(
        "a reel holds cable: it must be at an end of the route", "leave reel out, or end here"
    ),
    "reel-core": Message(
        "a core of {core:.4g} m fills the radius of {radius:.4g} m",
        "radius is that of the pack at the start, more than core",
    ),
    "moved-twice": Message(
        "a wheel moves by its motion or by the forces on its mass", "leave motion or mass out"
    ),
    "mount-moves": Message(
        "a mount is fixed to the ground: its wheel has no motion and no mass of its own",
        "leave mount out, or motion and mass",
    ),
    "reel-leans": Message(
        "the place where the cable leaves a reel does not move", "leave {word} out, or reel"
    ),
    "block-ways": Message(
        "station {i} is on the same block, and slides otherwise", "one slide and one pull for both"
    ),
    "no-carriage": Message("{word} is for a wheel that is free to move", "give it a mass"),
    "no-slide": Message("pull goes along slide", "slide = [1, 0, 0]"),
    "expression": Message(
        "{word}: {why}", "an expression of TIME; force, torque and pull may use S and SD"
    ),
    "law-start": Message(
        "{word} at TIME = 0 is {value:.4g} m", "it counts from the place in the route: 0"
    ),
    "law-no-value": Message(
        "{word} has no value at TIME = {time:.4g}",
        "no division by zero, no root or logarithm of a negative number, nothing above 1e50",
    ),
    "payout-too-far-in": Message(
        "at TIME = {time:.4g} the payout is {value:.4g} m: the cable of {length:.4g} m has no"
        " length left",
        "wind less in, end earlier, or put the end further away",
    ),
    "zero-span": Message("there is no cable between stations {i} and {j}", "move one of them"),
    "radius-over-spacing": Message(
        "the wheels of stations {i} and {j} reach over their spacing of {spacing:.4g} m:"
        " no cable fits between",
        "smaller radii, or stations further apart",
    ),
    "crossing": Message(
        "the route passes through itself: {what}", "move a station, or its turn = 1 or -1"
    ),
    "axis-along-cable": Message("the axis of this wheel lies along the cable", "axis = [0, 0, 1]"),
    "too-many": Message(
        "{word} makes {count} sections of one cable; it may have 1 to {most}",
        "fewer elements, or auto",
    ),
    "form-has-level": Message("form {form} belongs to level 3", "level = 3, or leave one out"),
    "needs-brute": Message(
        "{why}: only sections that run over the rims can represent that",
        'form = "brute"; a wheel may move where it and the wheels beside it lean: leans = true',
    ),
    "brute-no-wheel": Message(
        "form brute is for wheels, and there is none", "level = 2 has the same sections"
    ),
    "brute-cannot": Message(
        "form brute lays sections on rims of one radius, in one plane: no {word}",
        "level = 1, 2 or 3, or leave {word} out",
    ),
    "overstretched": Message(
        "the tension at rest stretches a cable of EA = {stiffness:.4g} N by half or more",
        "a larger EA, less weight, shorter spans",
    ),
    "brute-plane": Message(
        "sections round wheels and bends lie in one plane across their axes",
        "axles, places, velocities and gravity in that plane, or another form",
    ),
    "bend-too-tight": Message(
        "a section of {section:.4g} m does not fit round a radius of {radius:.4g} m",
        "a larger radius, or more elements",
    ),
    "speed-on-a-route": Message(
        "a cable with ends does not run along itself", "closed = true, or velocity of a mass"
    ),
    "slides-between": Message(
        "a weight slides between two points at which its cable ends",
        "beside it: fixed, free, or a mass or body that does not slide",
    ),
    "no-slider": Message("haul is for a weight that slides along its cable", "slides = true"),
    "slider-form": Message(
        "a weight slides at level 1 and in form ale only", 'level = 1, or form = "ale"'
    ),
    "pitches": Message(
        "the pitch of station {i} is {first:.6g} m, of station {j} {second:.6g} m",
        "2 R sin(pi/teeth) is one for all: radius = {radius:.8g}",
    ),
    "loop-of-links": Message(
        "the loop is {links:.3f} links long", "a whole number: change the spacings by {off:.4g} m"
    ),
    "rigid-cannot": Message("level 1 is a rigid cable: {what}", "level = 2 or 3"),
    "stored-too-little": Message(
        "the payout reaches {value:.4g} m, and {held:.4g} m are stored",
        "more cable stored, or an earlier end",
    ),
    "level-2-pays-out": Message(
        "level 2 has sections of {section:.4g} m and {travel:.4g} m of cable go over a wheel",
        "fewer elements, or level = 3",
        severity=WARNING,
    ),
    "level-2-unknown": Message(
        "level 2 has sections of {section:.4g} m, and how much cable goes over a wheel is not known"
        " before the run: {why}",
        "level = 3, or see that the run's travel stays below half a section",
        severity=WARNING,
    ),
    "rigid-has-waves": Message(
        "level 1 has no waves, and here they matter: {figures}",
        "level = {level}",
        severity=WARNING,
    ),
    "parts-form": Message(
        "a rigid cable, and one of form brute or with bends, does not part", "level = 2 or 3"
    ),
    "parts-where": Message(
        "a cable that parts needs the tension at which it does", "breaking_load = ... in [cable]"
    ),
    "breaking": Message(
        "the cable carries {tension:.4g} N at the start and breaks at {limit:.4g} N",
        "less load, or a stronger cable",
        severity=WARNING,
    ),
    "paper-not-valid": Message(
        "the paper's element is not accurate to {accuracy:g} here: {figures}",
        'form = "ale"',
        severity=WARNING,
    ),
    "pushed": Message(
        "the winch pays out with {gain:.4g} m/s^2 at TIME = {time:.4g}, and the load follows"
        " with {fall:.4g} m/s^2: the cable goes slack, and a slack section pushes",
        "pulls_only = true in [cable], at level 2 or 3: a slack section then carries nothing",
        severity=WARNING,
    ),
    "pushed-at-once": Message(
        "the winch pays out with {speed:.4g} m/s from the start, and the load moves with {own:.4g}"
        " m/s: the cable goes slack, and a slack section pushes",
        "pulls_only = true in [cable], at level 2 or 3, or give the load that velocity",
        severity=WARNING,
    ),
    "slackens": Message(
        "the tension falls to {least:.4g} N in the run: the cable goes slack, and a slack section"
        " pushes",
        "pulls_only = true in [cable], at level 2 or 3: a slack section then carries nothing",
        severity=WARNING,
    ),
    "goes-slack": Message(
        "the tension falls to {least:.4g} N in the run: the cable goes slack, and the sections of"
        " this deck carry nothing then",
        "pulls_only = true in [cable] says so in the description",
        severity=WARNING,
    ),
    "unsettled": Message(
        "runs have not shown that {model} will do for {accuracy:g}: {reached}",
        "trial = {more:g} in [model], or --trial {more:g}, allows more of them",
        severity=WARNING,
    ),
    "does-not-end": Message(
        "the run of this model does not come to its end: {why}",
        "another level, form or number of elements, or an earlier end",
        severity=WARNING,
    ),
    "runs-into-wheel": Message(
        "{what}", "end before that, or start the weight further from the wheel", severity=WARNING
    ),
    "pretension": Message(
        "{pretension:.4g} N of pretension where {hung:.4g} N hang: the cable starts out of balance,"
        " and the weight bounces",
        "leave pretension out: what hangs on the cable gives its tension",
        severity=WARNING,
    ),
    "faster-than-waves": Message(
        "the cable runs at {speed:.4g} m/s, faster than its transverse waves: {wave:.4g} m/s at"
        " {tension:.4g} N; displacements across it grow without bound",
        "more pretension, or a slower payout",
        severity=WARNING,
    ),
}


#: Letters of a value that a message shows.
LONGEST = 60


def quoted(value: object) -> str:
    """A value as a message shows it, its beginning where it is long."""
    try:
        text = repr(value)
    except ValueError:  # of thousands of digits Python makes no text
        return "a number of too many digits"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


#: Diagnostics of a description that are kept; of the others those whose code is new.
MOST = 1000


class Faults:
    """Collects the diagnostics of one description."""

    def __init__(self, places: Places) -> None:
        self.places = places
        self.guesses = Guesses()
        #: The last one counts those that are not kept.
        self.found: list[Diagnostic] = []
        self.codes: set[str] = set()
        #: Tables of the stations, where these are not in the order of the file.
        self.tables: list[int] = []
        #: Number of the table of the cable, where there are several.
        self.cable: int | None = None

    def of_cable(self, k: int) -> "Faults":
        """The same diagnostics, for paths of cable k of several."""
        own = Faults(self.places)
        own.found, own.codes, own.cable, own.guesses = self.found, self.codes, k, self.guesses
        return own

    def add(self, code: str, path: Path, **words: object) -> None:
        """Say `code` about the key at `path`, or with ``within=`` about a word of its value, given
        with the number of the time that it stands there; ``hint=`` replaces the hint of the
        table."""
        within = words.pop("within", None)
        at = within if isinstance(within, tuple) else ("", 0)
        if len(self.found) >= MOST and code in self.codes:
            self._count(MESSAGES[code].severity)
            return
        self.codes.add(code)
        message, span = MESSAGES[code], self.places.span(self._written(path), at)
        hint = str(words.pop("hint", "") or message.hint.format(**words))
        line, column = self.places.source.quote(span)
        text = message.sentence.format(**words)
        found = Diagnostic(code, message.severity, text, span, hint, line, column)
        counted = bool(self.found) and isinstance(self.found[-1], LeftOut)
        self.found.insert(len(self.found) - counted, found)

    def _count(self, severity: str) -> None:
        """One more that is not kept."""
        last = self.found[-1]
        numbers = [int(each == severity) for each in SEVERITIES]
        if isinstance(last, LeftOut):
            self.found.pop()
            numbers = [a + b for a, b in zip(numbers, last.numbers, strict=True)]
        self.found.append(LeftOut.of(numbers))

    def _written(self, path: Path) -> Path:
        """The same key of the table that describes a station or the cable."""
        if self.cable is not None and path[:1] == ("cable",) and len(path) < 3:
            return "cable", self.cable, *path[1:]
        if len(path) < 2 or path[0] != "route" or not self.tables:
            return path
        i = int(path[1])
        return "route", self.tables[i] if i < len(self.tables) else i, *path[2:]

    def copy(self) -> "Faults":
        """The same so far, for messages of its own."""
        other = Faults(self.places)
        other.found, other.tables, other.cable = list(self.found), self.tables, self.cable
        other.codes = set(self.codes)
        return other

    @property
    def errors(self) -> bool:
        """Whether there is any."""
        return any(each.is_error for each in self.found)
