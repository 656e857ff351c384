-- topic: threads
-- as: customization
-- passes: 8
-- spec: threads 4
-- note: modules that a thread loads may wait for steps, as those of V-REP's threads do; pcall around it still forbids that
sim = require 'sim'
package.preload['waiting'] = function(name, place)
    print('loading', name, place)
    for k = 1, 3 do
        local before = sim.getSimulationTime()
        sim.step()
        print('step', k, ('%.2f'):format(sim.getSimulationTime() - before))
    end
    return {answer = 5}
end
package.preload['broken'] = function()
    sim.step()
    error('broken on purpose')
end
package.preload['silent'] = function() sim.step() end

-- a busy module is not pre-empted, and the thread's own level comes back
package.preload['busy'] = function()
    local before = sim.getSimulationTime()
    for k = 1, 1e6 do end
    print('busy', sim.getSimulationTime() == before)
    return true
end

function sysCall_thread()
    local module = require 'waiting'
    print(module.answer, require 'waiting' == module, getAutoYield())
    print(require 'silent', package.loaded.silent)
    local before = sim.getSimulationTime()
    print(pcall(require, 'broken'))
    print('no step inside pcall', sim.getSimulationTime() == before, getAutoYield())
    print(select('#', xpcall(require, print, 'nonexistent')))
    require 'busy'
    require 'broken'
end
