#!/usr/bin/env python3
"""Manual pages and completion have every option of every command, with what it takes; pages are clean for groff, where that is
there; bash completes each option and each of its words. Usage: manual_test.py PDC"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PDC = sys.argv[1]


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def options_of(command):
    """Names, and the words that each takes."""
    text = output_of(PDC, command, "--help")
    return {name: words.split(",") if words else []
            for name, words in re.findall(r"^ +(?:-h,)?(--[a-z0-9-]+)(?: \S*?:\{([^}]*)\})?", text, re.M)}


def complete(script, *words):
    """What bash offers for the last of the words."""
    line = f'source "{script}"; COMP_WORDS=({" ".join(words)}); COMP_CWORD={len(words) - 1}; _pdc; printf "%s\\n" "${{COMPREPLY[@]}}"'
    return output_of("bash", "-c", line).split()


def main():
    program = output_of(PDC, "--help")
    commands = re.findall(r"^  ([a-z]+) ", program.split("Subcommands:")[1], re.M)
    assert len(commands) >= 12 and "manual" not in commands, commands
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "manual"
        subprocess.run([PDC, "manual", str(folder)], check=True)
        pages = sorted(path.name for path in folder.iterdir())
        assert pages == sorted(["pdc.1", "pdc.bash", *(f"pdc-{command}.1" for command in commands)]), pages
        if shutil.which("groff"):
            for page in folder.glob("*.1"):
                said = subprocess.run(["groff", "-man", "-ww", "-z", str(page)], capture_output=True, text=True)
                assert said.stderr == "", (page, said.stderr)
        script = folder / "pdc.bash"
        assert sorted(complete(script, "pdc", "''")) == sorted([*commands, "--help", "--version"])
        options = 0
        for command in commands:
            page = (folder / f"pdc-{command}.1").read_text().replace("\\-", "-")
            for option, words in options_of(command).items():
                assert f"{option}\\fR" in page, (command, option)
                assert option in complete(script, "pdc", command, option[:-1]), (command, option)
                options += 1
                if words:
                    assert complete(script, "pdc", command, option, "''") == sorted(words, key=words.index), (command, option)
        assert options > 150, options
        print(f"{options} options of {len(commands)} commands are in pages and completed")


if __name__ == "__main__":
    main()
