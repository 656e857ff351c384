-- topic: old names
-- as: sandbox
-- passes: 0
-- spec: vrep-era 1.3
sim = require 'sim'
print(sim.getObjectHandle('nope@silentError'))
print(sim.getCollectionHandle('nope@silentError'))
print(sim.getCollisionHandle('nope@silentError'))
print(sim.getDistanceHandle('nope@silentError'))
print(sim.getIkGroupHandle('nope@silentError'))
for _, f in ipairs{'getCollectionHandle', 'getCollisionHandle', 'getDistanceHandle', 'getIkGroupHandle'} do
    local ok, e = pcall(sim[f], 'nope')
    print(ok, (e:gsub('^%-?%d+: ', '')))
end
local ok, e = pcall(sim.getObjectHandle, 'nope')
local _, lines = e:gsub('\n', '\n')
print(ok, e:match('^[^\n]*'):gsub('^%-?%d+: ', ''), lines, e:find('"nope"', 1, true) ~= nil)
ok, e = pcall(sim.getObjectHandle, '/nope')
_, lines = e:gsub('\n', '\n')
print(ok, lines)
