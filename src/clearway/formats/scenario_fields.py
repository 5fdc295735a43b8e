"""Fields of a scenario file that may be spelled in several ways: poses, polygons, footprints."""

import math
from typing import Annotated, Any, Final

from pydantic import BeforeValidator, Field, PlainValidator, WithJsonSchema

from clearway.formats.scenario_error import Misfit, closest
from clearway.model import Footprint, Point, Polygon, Pose

FARTHEST: Final = 1e7
LARGEST_BODY: Final = 100.0
FULL_TURN: Final = 2.0 * math.pi + 1e-6

_NUMBER = {"type": "number"}
_POINT = {"type": "array", "items": _NUMBER, "minItems": 2, "maxItems": 2}
_POLYGON = {"type": "array", "items": _POINT, "minItems": 3}
_RECTANGLE = [[1.5, 1.0], [-1.5, 1.0], [-1.5, -1.0], [1.5, -1.0]]


def read_number(value: object, path: tuple[str | int, ...] = (), unit: str = "m") -> float:
    """Return a finite number of at most 1e7, or raise `Misfit` at ``path``."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise Misfit("must be a number", f"write a number ({unit})", value, path)
    if not abs(value) <= FARTHEST:
        mend = f"write it in {unit}, counted from an origin near the site"
        raise Misfit(f"must be within {FARTHEST:g}", mend, value, path)
    return float(value)


def _read_list(value: object, length: int, what: str, path: tuple[str | int, ...]) -> list[Any]:
    if not isinstance(value, list) or len(value) != length:
        raise Misfit(f"must be {what}", f"write {what}", value, path)
    return value


def read_point(value: object, path: tuple[str | int, ...] = ()) -> Point:
    """Read ``[x, y]``."""
    x, y = _read_list(value, 2, "two numbers [x, y]", path)
    return read_number(x, (*path, 0)), read_number(y, (*path, 1))


def read_heading(value: object, path: tuple[str | int, ...] = ()) -> float:
    """Read an angle in radians; refuse more than one full turn, which degrees would be."""
    theta = read_number(value, path, "rad")
    if abs(theta) > FULL_TURN:
        mend = "angles are in radians; for degrees write {x = .., y = .., theta_deg = ..}"
        raise Misfit("must be at most a full turn, 2 pi", mend, value, path)
    return theta


def read_pose(value: object) -> Pose:
    """Read ``[x, y, theta]``, ``{x, y, theta}`` or ``{x, y, theta_deg}``."""
    if not isinstance(value, dict):
        shape = "three numbers [x, y, theta] or {x = .., y = .., theta_deg = ..}"
        x, y, theta = _read_list(value, 3, shape, ())
        return Pose(read_number(x, (0,)), read_number(y, (1,)), read_heading(theta, (2,)))
    for key in value:
        if key not in ("x", "y", "theta", "theta_deg"):
            mend = closest(key, ("x", "y", "theta", "theta_deg"))
            raise Misfit("unknown key", mend, value[key], (key,))
    if "x" not in value or "y" not in value or ("theta" in value) == ("theta_deg" in value):
        mend = "write {x = .., y = .., theta_deg = ..}"
        raise Misfit("needs x, y and one of theta and theta_deg", mend, value)
    x, y = read_number(value["x"], ("x",)), read_number(value["y"], ("y",))
    if "theta" in value:
        return Pose(x, y, read_heading(value["theta"], ("theta",)))
    degrees = read_number(value["theta_deg"], ("theta_deg",), "degrees")
    if abs(degrees) > 360.0:
        mend = "write degrees between -180 and 180"
        raise Misfit("must be at most a full turn", mend, degrees, ("theta_deg",))
    return Pose(x, y, math.radians(degrees))


def _read_corners(value: object, path: tuple[str | int, ...]) -> Polygon:
    if not isinstance(value, list) or len(value) < 3:
        mend = "list its corners [[x, y], [x, y], [x, y], ..]"
        raise Misfit("must be at least 3 points", mend, value, path)
    return tuple(read_point(point, (*path, i)) for i, point in enumerate(value))


def read_polygon(value: object) -> Polygon:
    """Read a simple polygon ``[[x, y], ..]``; refuse one that cuts or touches itself."""
    import shapely

    corners = _read_corners(value, ())
    shape = shapely.Polygon(corners)
    is_simple = shape.is_valid and shapely.LinearRing(corners).is_simple
    if shape.convex_hull.area < 1e-9 or (is_simple and shape.area < 1e-9):
        raise Misfit("has no area", "list corners that are not all on one line", value)
    if not is_simple:
        where = shapely.is_valid_reason(shape)
        mend = "list the corners once round, so that no two edges cross or touch"
        raise Misfit(f"cuts or touches itself ({where})", mend, value)
    return corners


def read_footprint(value: object) -> Footprint:
    """Read one convex polygon, a list of them (their union) or ``{disc = radius}``."""
    if isinstance(value, dict):
        if set(value) != {"disc"}:
            mend = "write {disc = radius} or a list of corners"
            raise Misfit("a table here has the one key disc", mend, value)
        radius = read_number(value["disc"], ("disc",))
        if not 0.0 < radius <= LARGEST_BODY:
            mend = "write the radius in m"
            raise Misfit(f"must be above 0 and at most {LARGEST_BODY:g}", mend, radius, ("disc",))
        return Footprint(radius=radius)
    given, nested = [value], False
    match value:
        case [[[*_], *_], *_]:
            given, nested = list(value), True
    parts = []
    for i, part in enumerate(given):
        path = (i,) if nested else ()
        corners = _read_corners(part, path)
        if max(math.hypot(x, y) for x, y in corners) > LARGEST_BODY:
            mend = "write the corners in m, counted from the robot's reference point"
            raise Misfit(f"reaches farther than {LARGEST_BODY:g} m", mend, part, path)
        try:
            Footprint(parts=(corners,))
        except ValueError as error:
            what = str(error).removeprefix("footprint part 0 ").split(";")[0]
            mend = "list the corners of a convex polygon once round, or several such polygons"
            raise Misfit(what, mend, part, path) from error
        parts.append(corners)
    return Footprint(parts=tuple(parts))


def read_disc(value: object) -> tuple[float, float, float]:
    """Read ``[x, y, radius]``."""
    x, y, r = _read_list(value, 3, "three numbers [x, y, radius]", ())
    disc = (read_number(x, (0,)), read_number(y, (1,)), read_number(r, (2,)))
    if disc[2] <= 0.0:
        raise Misfit("a radius must be above 0", "write the radius in m", r, (2,))
    return disc


def read_wall(value: object) -> tuple[Point, Point]:
    """Read ``[[x, y], [x, y]]``."""
    a, b = _read_list(value, 2, "two points [[x, y], [x, y]]", ())
    wall = (read_point(a, (0,)), read_point(b, (1,)))
    if wall[0] == wall[1]:
        raise Misfit("a wall's two points coincide", "give the wall a length", value)
    return wall


def _schema(description: str, example: object, *shapes: dict[str, Any]) -> WithJsonSchema:
    shape = shapes[0] if len(shapes) == 1 else {"anyOf": list(shapes)}
    return WithJsonSchema({**shape, "description": description, "examples": [example]})


def _table(required: list[str], **properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": False,
    }


_TRIPLE = {"type": "array", "items": _NUMBER, "minItems": 3, "maxItems": 3}
_TURN = {"type": "number", "minimum": -FULL_TURN, "maximum": FULL_TURN}
_POSE_TABLES = (
    _table(["x", "y", "theta"], x=_NUMBER, y=_NUMBER, theta=_TURN),
    _table(
        ["x", "y", "theta_deg"],
        x=_NUMBER,
        y=_NUMBER,
        theta_deg={"type": "number", "minimum": -360, "maximum": 360},
    ),
)

PoseField = Annotated[
    Pose,
    PlainValidator(read_pose),
    _schema(
        "Pose [x, y, theta] in m and rad, or a table with theta_deg in degrees.",
        [5.0, 3.0, 0.0],
        _TRIPLE,
        *_POSE_TABLES,
    ),
]
PolygonField = Annotated[
    Polygon,
    PlainValidator(read_polygon),
    _schema("Simple polygon, corners in m.", [[0, 0], [10, 0], [10, 5], [0, 5]], _POLYGON),
]
FootprintField = Annotated[
    Footprint,
    PlainValidator(read_footprint),
    _schema(
        "Shape about the reference point, x forward (m): a convex polygon, a list of them "
        "(their union) or {disc = radius}.",
        _RECTANGLE,
        _POLYGON,
        {"type": "array", "items": _POLYGON, "minItems": 1},
        _table(["disc"], disc={"type": "number", "exclusiveMinimum": 0, "maximum": LARGEST_BODY}),
    ),
]
DiscField = Annotated[
    tuple[float, float, float],
    PlainValidator(read_disc),
    _schema("Disc [x, y, radius] (m).", [20.0, 30.0, 1.5], _TRIPLE),
]
WallField = Annotated[
    tuple[Point, Point],
    PlainValidator(read_wall),
    _schema(
        "Wall without thickness, two points (m).",
        [[0.0, 10.0], [8.0, 10.0]],
        {"type": "array", "items": _POINT, "minItems": 2, "maxItems": 2},
    ),
]


def read_name(value: object) -> str:
    """Read an id or a name: 1 to 200 printable characters."""
    if not isinstance(value, str):
        raise Misfit("must be a string", "write a name in quotes", value)
    if not value.strip() or len(value) > 200 or not value.isprintable():
        mend = "write 1 to 200 printable characters"
        raise Misfit("is not usable as a name", mend, value)
    return value


Name = Annotated[
    str,
    PlainValidator(read_name),
    WithJsonSchema({"type": "string", "minLength": 1, "maxLength": 200}),
]
Seconds = Annotated[float, Field(ge=0.0, le=1e9)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]


def _listed(value: object) -> object:
    return value if isinstance(value, list) else [value]


_FILE = {"type": "string", "minLength": 1}
_LEVEL = {"type": "number", "minimum": 0, "maximum": 1}

FileNames = Annotated[
    list[Name],
    BeforeValidator(_listed),
    _schema(
        "Order files (.csv, .jsonl), named from the scenario file's folder.",
        "orders.csv",
        _FILE,
        {"type": "array", "items": _FILE},
    ),
]
Levels = Annotated[
    list[Share],
    Field(min_length=1, max_length=2),
    BeforeValidator(_listed),
    _schema(
        "Level of their batteries at the start in [0, 1], or the first robot's and the last's.",
        [0.15, 1.0],
        _LEVEL,
        {"type": "array", "items": _LEVEL, "minItems": 1, "maxItems": 2},
    ),
]
