--[[
Scripts from before callbacks existed: their whole text runs for each call and distinguishes calls by sim_call_type.

Arguments: the text as a function, and names of callbacks with their old numbers. The text runs once as its
initialization; then each callback is a function that runs it again.
]]
local run, init, callbacks = ...

sim_call_type = init
run()
addLog(430, [[the script is running in compatibility mode. It is highly recommended to switch to the new calling method, e.g.:
with the old method:
    if (sim_call_type==sim.syscb_init) then ... end
with the new method:
    function sysCall_init() ... end]])
for name, number in pairs(callbacks) do
    _G[name] = function(...)
        sim_call_type = number
        return run(...)
    end
end
