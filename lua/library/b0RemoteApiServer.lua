--[[
Server of the remote API over BlueZero, which ended with CoppeliaSim 4.4: scripts of models of that time require it. They end with an error that says what to use instead.
]]

function sysCall_init()
    error('b0RemoteApiServer needs the plugin simB0, which is gone; the ZeroMQ remote API is in its place: `swanilda serve` (docs/REMOTE_API.md)', 0)
end

return {}
