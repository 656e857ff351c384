# Where a text is no Python: its first error as JSON, or nothing. The text is compiled and never run.
import json
import sys


def column(line, offset):
    """Of an error, counted in the units of UTF-16 as pages do, from 1; null where Python does not say."""
    if not offset or offset < 1:
        return None
    return len(line[: offset - 1].encode("utf-16-le")) // 2 + 1


def found(text):
    try:
        compile(text, "script", "exec", dont_inherit=True)
    except SyntaxError as error:
        number = max(error.lineno or 1, 1)
        lines = text.split("\n")
        line = lines[number - 1] if number <= len(lines) else ""
        is_one_line = getattr(error, "end_lineno", None) == error.lineno
        end = getattr(error, "end_offset", None) if is_one_line else None
        return {"line": number, "column": column(line, error.offset), "end": column(line, end), "message": error.msg}
    except (ValueError, RecursionError, MemoryError, OverflowError) as error:
        return {"line": 1, "column": None, "end": None, "message": str(error) or type(error).__name__}
    return None


print(json.dumps(found(sys.stdin.buffer.read().decode("utf-8", "replace").replace("\r\n", "\n"))))
