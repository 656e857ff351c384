"""Errors as the script's author reads them: only the frames of his own code."""
import sys
import traceback


foreign = {'<string>'}  # names of files whose frames are not shown


def is_own(filename):
    return not (filename.startswith('<swanilda_') or filename in foreign)


def describe(error):
    """The traceback of an error."""
    described = traceback.TracebackException.from_exception(error)
    drop_foreign(described, set())
    return ''.join(described.format()).rstrip('\n')


def drop_foreign(described, seen):
    if described is None or id(described) in seen:
        return
    seen.add(id(described))
    described.stack = traceback.StackSummary.from_list([frame for frame in described.stack if is_own(frame.filename)])
    drop_foreign(described.__cause__, seen)
    drop_foreign(described.__context__, seen)


def calls_in_progress():
    """The traceback of the code that is running."""
    frames = traceback.extract_stack(sys._getframe(1))
    # Below the first frame of a script is the program, where scripts run in one.
    first = next((place for place, frame in enumerate(frames) if frame.filename.startswith('<swanilda_')), 0)
    frames = [frame for frame in frames[first:] if is_own(frame.filename)]
    return 'Traceback (most recent call last):\n' + ''.join(traceback.format_list(frames)).rstrip('\n')
