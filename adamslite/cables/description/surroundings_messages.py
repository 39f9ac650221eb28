"""Messages about water, a sea bed, bending and the length of a cable."""

from adamslite.language.messages.entry import Message

SURROUNDINGS = {
    "no-diameter": Message("{word} needs the diameter of the cable", "diameter = 0.05 in [cable]"),
    "no-depth": Message(
        "{word} has a height, and there is no gravity to say which way is up",
        "gravity = [0, -9.81, 0], or leave {word} out",
    ),
    "no-bending": Message("{word} is for a cable that resists bending", "bending = EI in [cable]"),
    "damped-twice": Message(
        "damping and damping_time both say how the material damps", "leave one of them out"
    ),
    "length-of-what": Message(
        "length is that of a cable between two fixed points, and the route has others",
        "leave length out: what hangs on the cable and pretension give it",
    ),
    "length-and-tension": Message(
        "the tension of a cable of given length is not free", "leave pretension or length out"
    ),
    "length-too-short": Message(
        "the cable of {length:.4g} m would be stretched to {spacing:.4g} m", "a greater length"
    ),
    "length-too-long": Message(
        "the cable of {length:.4g} m is drawn over {spacing:.4g} m: it hangs slack, off its line",
        "a smaller length",
    ),
    "no-nodes": Message(
        "{word} acts on the nodes of a cable, and {where}",
        "level = 2 or 3; wheels beside each other further from the water, or leave {word} out",
    ),
    "below-bed": Message(
        "station {i} is {depth:.4g} m below the bed", "a lower level of the bed, or a higher place"
    ),
}
