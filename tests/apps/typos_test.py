#!/usr/bin/env python3
"""A hundred mistyped commands and options: the one that was meant is named for ninety at least. Usage: typos_test.py PDC"""
import random
import re
import subprocess
import sys

PDC = sys.argv[1]


def help_of(*command):
    return subprocess.run([PDC, *command, "--help"], capture_output=True, text=True, check=True).stdout


def mistyped(word, rng):
    """With a letter left out, twice, changed or exchanged with its neighbour."""
    at = rng.randrange(1, len(word) - 1)
    kind = rng.randrange(4)
    if kind == 0:
        return word[:at] + word[at + 1 :]
    if kind == 1:
        return word[:at] + word[at] + word[at:]
    if kind == 2:
        return word[:at] + rng.choice("abcdefghijklmnopqrstuvwxyz") + word[at + 1 :]
    return word[: at - 1] + word[at] + word[at - 1] + word[at + 1 :]


def main():
    commands = re.findall(r"^  ([a-z]+) ", help_of().split("Subcommands:")[1], re.M)
    options = {command: sorted(set(re.findall(r"--([a-z-]{3,})", help_of(command)))) for command in commands}
    rng = random.Random(1)
    named, tried, missed = 0, 0, []
    while tried < 100:
        command = rng.choice(commands)
        if tried % 4 == 0:
            meant, typo = command, mistyped(command, rng)
            known, arguments = commands, [typo, "a", "b"]
        else:
            meant = rng.choice(options[command])
            typo = mistyped(meant, rng)
            known, arguments = options[command], [command, "a", "b", f"--{typo}"]
        if typo in known:
            continue
        tried += 1
        run = subprocess.run([PDC, *arguments], capture_output=True, text=True)
        assert run.returncode == 2 and run.stderr.count("\n") == 1, (arguments, run.stderr)
        if re.search(rf"did you mean '(--)?{meant}'", run.stderr):
            named += 1
        else:
            missed.append((typo, meant, run.stderr.strip()))
    print(f"{named} of {tried} are named; not:", *missed, sep="\n")
    assert named >= 90


if __name__ == "__main__":
    main()
