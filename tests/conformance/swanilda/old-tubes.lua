-- topic: tubes
-- as: sandbox
-- passes: 0
-- note: tubes of V-REP: two ends of the same header and name, packets in order, a limit of packets that wait
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function count(...) return select('#', ...) end

local a = sim.tubeOpen(5, 'tube', 2)
print('alone', sim.tubeStatus(a))
print('lost', sim.tubeWrite(a, 'nobody reads'))
local other = sim.tubeOpen(5, 'other', 0)
print('another name', sim.tubeStatus(a))
local b = sim.tubeOpen(5, 'tube', 0)
print('both', a ~= b, sim.tubeStatus(a))
print('empty', count(sim.tubeRead(b)))
print('write', sim.tubeWrite(a, 'one'), sim.tubeWrite(a, 'two\0'), sim.tubeWrite(a, ''))
print('status', sim.tubeStatus(a))
print('status', sim.tubeStatus(b))
local packet = sim.tubeRead(b)
print('read', type(packet), isbuffer(packet), packet, #sim.tubeRead(b), #sim.tubeRead(b), count(sim.tubeRead(b)))

-- Two packets wait at most: the oldest one makes room.
for _, text in ipairs{'1', '2', '3'} do sim.tubeWrite(b, text) end
print('limited', sim.tubeStatus(a))
print('limited', sim.tubeRead(a), sim.tubeRead(a), count(sim.tubeRead(a)))

print('close', sim.tubeClose(a), sim.tubeClose(a), sim.tubeWrite(a, 'x'), count(sim.tubeRead(a)))
print('left', sim.tubeStatus(b))
print('lost', sim.tubeWrite(b, 'x'))
print('none', (sim.tubeStatus(a)), (sim.tubeStatus(12345)), sim.tubeClose(12345))
