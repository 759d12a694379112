"""Runs dotek once and says what is wrong with how it ended."""

import json
import os
import pathlib
import signal
import subprocess
import time

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
SLOW = 10.0  # seconds

_ENVIRONMENT = dict(
    os.environ,
    ASAN_OPTIONS="detect_container_overflow=0:detect_leaks=0:allocator_may_return_null=0",
    UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1",
)
_DEFECTS = (b"Sanitizer", b"runtime error", b"terminate called", b"defect of Dotek")


def _no_constant(name):
    raise ValueError(name)  # NaN, Infinity


def schema(name):
    path = ROOT / ("tests/third_party/sarif-2.1.0.json" if name == "sarif" else f"docs/schemas/{name}.schema.json")
    return json.loads(path.read_text())


class Validators:
    """Checks what a command prints against the schema of its format."""

    def __init__(self):
        self._made = {}

    def fault(self, name, text):
        if name not in self._made:
            found = schema(name)
            self._made[name] = jsonschema.validators.validator_for(found)(found)
        try:
            value = json.loads(text.decode("utf-8"), parse_constant=_no_constant)
        except ValueError as error:
            return f"no JSON: {error}"
        error = jsonschema.exceptions.best_match(self._made[name].iter_errors(value))
        return f"not of the schema {name}: {error.message[:120]}" if error else None


class Judge:
    """dotek, the time that a run may take, and how many times as long the program takes than a release build."""

    def __init__(self, dotek, limit):
        self.dotek = str(pathlib.Path(dotek).resolve())
        self.limit = limit
        self.exits = {}
        self.slowest = (0.0, "")
        self._validators = Validators()

    def document(self, schema, text):
        """What is wrong with a text that is to keep to the schema, or None."""
        return self._validators.fault(schema, text)

    def run(self, arguments, folder, prints=None, files=(), stdin=None):
        """What is wrong, or None. `prints` names the schema of standard output, `files` are (path, schema), `stdin` is a file."""
        begin = time.monotonic()
        given = open(pathlib.Path(folder) / stdin, "rb") if stdin else subprocess.DEVNULL
        process = subprocess.Popen(
            [self.dotek, *arguments], cwd=folder, env=_ENVIRONMENT, start_new_session=True,
            stdin=given, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            out, err = process.communicate(timeout=self.limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return f"does not end within {self.limit:g} s"
        finally:
            if stdin:
                given.close()
        took = time.monotonic() - begin
        self.exits[process.returncode] = self.exits.get(process.returncode, 0) + 1
        if took > self.slowest[0]:
            self.slowest = (took, " ".join(map(str, arguments)))
        if process.returncode not in (0, 1, 2):
            return f"exit status {process.returncode}: {_last(err)}"
        if any(word in err for word in _DEFECTS):
            return f"defect: {_last(err)}"
        if process.returncode != 0 and not err and not out:
            return "fails without a word"
        if took > SLOW:
            return f"takes {took:.1f} s"
        if prints:
            fault = self._validators.fault(prints, out)
            if fault:
                return fault
        for path, name in files:
            path = pathlib.Path(folder) / path
            if path.exists():
                fault = self._validators.fault(name, path.read_bytes())
                if fault:
                    return f"{path.name}: {fault}"
        return None


def _last(err):
    return err[-300:].decode("latin1").replace("\n", " | ")
