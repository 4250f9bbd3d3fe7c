# What a program says of itself (--describe, --xml, --catalogue), checked; prints calls that it must refuse, for manners.sh.
# SPDX-License-Identifier: GPL-3.0-or-later
import json
import re
import sys
import xml.etree.ElementTree as ElementTree


def numbers(option):
    return option["kind"] in ("real", "integer")


def inside(value, low, high):
    return (low is None or value >= low) and (high is None or value <= high)


def check_option(option):
    name = option["name"]
    assert re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", name), f"{name}: not a name of words joined by '-'"
    assert len(option["meaning"]) > 5, f"{name}: no meaning"
    assert "default" in option and "unit" in option, f"{name}: no default or unit"
    if numbers(option):
        assert option["unit"], f"{name}: a number without unit"
        assert "min" in option and "max" in option, f"{name}: no range"
        assert option["default"] is None or inside(option["default"], option["min"], option["max"]), f"{name}: default out of range"
    if option["kind"] == "choice":
        assert option["default"] in option["choices"], f"{name}: the default is no choice"


def check_describe(program, told):
    assert told["schema"] == "palpate-describe/1" and told["name"] == program
    assert told["sentence"].endswith("."), "the sentence has no full stop"
    for argument in told["inputs"] + told["outputs"]:
        assert argument["name"] and argument["kind"] in ("file", "folder") and len(argument["meaning"]) > 5, argument
    options = told["options"] + told["common_options"]
    for option in options:
        check_option(option)
    names = [option["name"] for option in options]
    assert len(names) == len(set(names)), "an option twice"
    common = {option["name"] for option in told["common_options"]}
    assert {"threads", "seed", "quiet", "verbose", "force"} <= common, common
    for command in told.get("commands", []):
        check_describe(command["name"], command)


def check_xml(told, path):
    root = ElementTree.parse(path).getroot()
    assert root.tag == "executable" and root.findtext("description") == told["sentence"]
    flags = [element.text for element in root.iter("longflag")]
    if "commands" not in told:
        assert flags == ["--" + option["name"] for option in told["options"] + told["common_options"]], flags
    for element in root.iter("integer"):
        for number in [element.findtext("default"), *[bound.text for bound in element.iter() if bound.tag in ("minimum", "maximum")]]:
            assert number is None or re.fullmatch(r"-?[0-9]+", number), f"{number} is no integer"


def check_catalogue(entries):
    for entry in entries:
        assert entry["kind"] and entry["name"] and len(entry["sentence"]) > 5, entry
        for parameter in entry["parameters"]:
            assert parameter["unit"] and parameter["meaning"], (entry["name"], parameter)
            assert inside(parameter["typical"], parameter["min"], parameter["max"]), (entry["name"], parameter)


def refusals(told):
    """(word on stderr, arguments) of calls that are misuse whatever the files are."""
    files = [argument["name"] for argument in told["inputs"]]
    files += [argument.get("example", "x") for argument in told["outputs"] if "beside" not in argument]
    once = set()  # kinds of refusal that need one try a program; tests/words tries the parser itself
    for option in told["options"] + told["common_options"]:
        name, kind = option["name"], option["kind"]
        if len(name) > 5 and "name" not in once:
            yield f"--{name}?", files + [f"--{name[:2]}{name[3:]}"]
            once.add("name")
        if kind == "choice":
            yield "unknown choice", files + [f"--{name}", "no-such-choice"]
        if numbers(option):
            if kind not in once:
                yield f"--{name}", files + [f"--{name}", "nan"]
            bound, sign = (option["max"], 1) if option["min"] is None else (option["min"], -1)
            if bound is not None:
                yield f"--{name}", files + [f"--{name}={bound + sign * (1 + abs(bound) * 0.01):.15g}"]
        if kind == "points" and kind not in once:
            yield f"--{name}", files + [f"--{name}", "1,2"]
        once.add(kind)


def main(arguments):
    if arguments[0] == "--files":
        told = json.load(open(arguments[1]))
        for channel in ("input", "output"):
            for argument in told[channel + "s"]:
                if "beside" not in argument:
                    print(channel, argument["kind"], argument["example"], sep="\t")
        return
    program, describe, xml, catalogue = arguments
    told = json.load(open(describe))
    check_describe(program, told)
    check_xml(told, xml)
    check_catalogue(json.load(open(catalogue)))
    if "commands" in told:
        print("did you mean run?\trum")
        return
    for word, words in refusals(told):
        print(word, " ".join(words), sep="\t")


main(sys.argv[1:])
