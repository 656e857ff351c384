--[[
Programs that a script starts. Switched off by `--no-unsafe`.

    exec(programPath, args, input = '', opts = {})      runs a program to its end; the simulator waits, ctrl-c ends it with an error.
                                                        Returns exit code, output and error output, at most 256 MiB of each
    execAsync(programPath, args, opts = {})             starts a program, which writes where the simulator writes. Returns a handle
    isRunning(handle)                                   whether it still runs
    wait(handle, timeout = 5.0)                         waits that many seconds; returns its exit code, or nil if it still runs
    kill(handle)                                        ends it at once; the handle is void then
    getpid(handle)                                      the system's number of the process

args is a list of strings. opts: useSearchPath (true) looks a name up in PATH, workingDir is a folder, openNewConsole is for Windows.

A handle belongs to the script that got it. When the script ends, its programs are killed.
A program that ends by a signal is an error: the process crashed. So is one that cannot be started: waitForStarted timed out.
]]

local _, native = ...

return native
