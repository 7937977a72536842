"""Finds the program and starts it; its errors become exceptions with its message."""
import os
import shutil
import subprocess
from pathlib import Path


class IrkError(Exception):
    """An error of the program; the text is its own."""


class Misuse(IrkError, ValueError):
    """A wrong argument (exit status 2): the text names place, value and allowed range."""


class Failure(IrkError, RuntimeError):
    """The work could not be done (exit status 1)."""


class RunFailed(Failure):
    """An integration that ended with another outcome than success; `result` has what was computed."""

    def __init__(self, message, result):
        super().__init__(message)
        self.result = result


def program():
    """The path of the program: the variable IRK_PROGRAM, else `irk` of the sources that contain this package (which
    builds the program if anything has changed), else `irk` on the PATH. Raises Failure if there is none."""
    given = os.environ.get("IRK_PROGRAM")
    if given:
        if os.access(given, os.X_OK):
            return str(Path(given).resolve())
        raise Failure(f"IRK_PROGRAM = '{given}': a program is expected")
    sources = Path(__file__).resolve().parents[3]
    if (sources / "irk").is_file() and (sources / "core").is_dir():
        return str(sources / "irk")
    found = shutil.which("irk")
    if not found:
        raise Failure("no program irk: set IRK_PROGRAM to its path, or put it on the PATH")
    return found


def call(*arguments, accept=(0,)):
    """Starts the program with these arguments, without a shell. Returns (status, output, messages).

    Raises Misuse for the status 2, KeyboardInterrupt for 130, and Failure for any other that is not in `accept`."""
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL)
    if done.returncode in accept:
        return done.returncode, done.stdout, done.stderr
    if done.returncode == 130:
        raise KeyboardInterrupt
    raise (Misuse if done.returncode == 2 else Failure)(message_of(done.stderr) or f"exit status {done.returncode}")


def message_of(messages):
    """The last line that begins with `irk: `, without that; empty if there is none."""
    lines = [line[5:] for line in messages.splitlines() if line.startswith("irk: ")]
    return lines[-1] if lines else ""


def option(name):
    """`jacobian_point` as the program's option `--jacobian-point`."""
    return "--" + name.replace("_", "-")


def text(value):
    """A value of an option: numbers with all their digits, lists with commas."""
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist"):
        values = value.tolist() if hasattr(value, "tolist") else value
        if not isinstance(values, (list, tuple)):
            return text(values)
        return ",".join(text(one) for one in values)
    return repr(value) if isinstance(value, float) else str(value)
