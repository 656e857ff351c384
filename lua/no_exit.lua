--[[
What scripts must not do whose simulator shares its process with others, as in `swanilda test`: end the process. Internal.
]]

function os.exit() error('os.exit: the process is not this script\'s to end.', 2) end
