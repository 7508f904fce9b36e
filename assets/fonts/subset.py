"""Makes the fonts of the window from their sources. Needs fontTools (`pip install fonttools`).

    subset.py INTER PHOSPHOR

INTER is `Inter-roman.var.ttf` of Debian's package `fonts-inter-variable`, PHOSPHOR the folder
`src/regular` of the npm package `@phosphor-icons/web`. The results are written beside this script.
The names of the icons are read from `src/gui/icons.rs`.
"""

import json
import re
import sys
from pathlib import Path

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont
from fontTools.varLib.instancer import instantiateVariableFont

HERE = Path(__file__).parent
ICONS = HERE.parent.parent / "src" / "gui" / "icons.rs"

# Latin, Greek, punctuation, superscripts and subscripts, arrows and mathematical signs.
CHARACTERS = [
    (0x20, 0x7E),
    (0xA0, 0x17F),
    (0x370, 0x3FF),
    (0x2010, 0x203F),
    (0x2044, 0x2044),
    (0x2070, 0x209F),
    (0x20AC, 0x20AC),
    (0x2122, 0x2122),
    (0x2150, 0x215F),
    (0x2190, 0x21FF),
    (0x2200, 0x22FF),
    (0x25A0, 0x25FF),
]


def inter(source: str, weight: int, result: str) -> None:
    font = instantiateVariableFont(TTFont(source), {"wght": weight})
    tabular_digits(font)
    # Thousands are separated by U+00A0, for which a whole space is too wide.
    space = font.getBestCmap()[0xA0]
    width, bearing = font["hmtx"][space]
    font["hmtx"][space] = (width // 2, bearing)
    codes = [code for first, last in CHARACTERS for code in range(first, last + 1)]
    save(font, codes, ["ccmp", "kern", "mark", "mkmk"], HERE / result)


def tabular_digits(font: TTFont) -> None:
    """Maps the digits to their glyphs of equal width, because egui cannot turn on `tnum`."""
    table = font["GSUB"].table
    lookups = {
        lookup
        for record in table.FeatureList.FeatureRecord
        if record.FeatureTag == "tnum"
        for lookup in record.Feature.LookupListIndex
    }
    tabular = {}
    for lookup in lookups:
        for subtable in table.LookupList.Lookup[lookup].SubTable:
            tabular.update(getattr(subtable, "ExtSubTable", subtable).mapping)
    digits = range(ord("0"), ord("9") + 1)
    equal = {digit: tabular[font.getBestCmap()[digit]] for digit in digits}
    # At weight 600 one digit is a thousandth of an em narrower.
    width = max(font["hmtx"][glyph][0] for glyph in equal.values())
    for glyph in equal.values():
        font["hmtx"][glyph] = (width, font["hmtx"][glyph][1])
    for cmap in font["cmap"].tables:
        if cmap.isUnicode():
            cmap.cmap.update(equal)


def phosphor(folder: str, result: str) -> None:
    icons = json.loads((Path(folder) / "selection.json").read_text())["icons"]
    codes = {
        name: icon["properties"]["code"]
        for icon in icons
        for name in icon["properties"]["name"].split(", ")
    }
    constants = re.findall(r'"\\u\{([0-9a-f]+)\}"; // ([a-z-]+)$', ICONS.read_text(), re.M)
    for code, name in constants:
        assert int(code, 16) == codes[name], f"{name} has the code {codes[name]:x}, not {code}"
    font = TTFont(Path(folder) / "Phosphor.ttf")
    save(font, [int(code, 16) for code, _ in constants], [], HERE / result)


def save(font: TTFont, codes: list[int], features: list[str], path: Path) -> None:
    options = Options()
    options.layout_features = features
    options.hinting = False
    options.name_IDs = [0, 1, 2, 3, 4, 5, 6, 13, 14]
    # Equal sources make equal files.
    options.recalc_timestamp = False
    font.recalcTimestamp = False
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=codes)
    subsetter.subset(font)
    font.save(path)
    print(path.name, path.stat().st_size, "bytes,", len(font.getBestCmap()), "characters")


if __name__ == "__main__":
    inter(sys.argv[1], 400, "Inter-Regular.ttf")
    inter(sys.argv[1], 600, "Inter-SemiBold.ttf")
    phosphor(sys.argv[2], "Phosphor.ttf")
