"""Colours that people with any colour vision can tell apart."""

# Okabe, M. and Ito, K. (2008). Color Universal Design. Without black and with yellow last,
# which is faint on white.
ROBOT_COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442")
# The same, darkened where thin lines on white need it.
_LINES = ("#0072B2", "#B87A00", "#007F5C", "#B0568A", "#2E8FC4", "#C05400", "#8F8500")
# And lightened where they need it on dark ground.
_LINES_ON_DARK = ("#56B4E9", "#F0B429", "#2FC096", "#E39BC4", "#A3D4F5", "#FF8A4C", "#F0E442")


def robot_colour(index: int) -> str:
    """Return the colour of the robot at ``index`` in its fleet; colours repeat after seven."""
    return ROBOT_COLOURS[index % len(ROBOT_COLOURS)]


def line_colour(index: int, on_dark: bool = False) -> str:
    """Return the robot's colour for thin lines on white, or on dark ground."""
    lines = _LINES_ON_DARK if on_dark else _LINES
    return lines[index % len(lines)]
