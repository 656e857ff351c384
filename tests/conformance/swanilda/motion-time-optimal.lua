-- topic: motion
-- as: simulation
-- passes: 2
-- sim.generateTimeOptimalTrajectory: closed forms, limits, refusals.
sim = require 'sim'

local function refused(...) print((select(2, pcall(sim.generateTimeOptimalTrajectory, ...)):gsub('^.-: ', ''))) end

function sysCall_init()
    local generate = sim.generateTimeOptimalTrajectory
    local path, times = generate({0, 0, 1, 1}, {0, 1}, {-1, 1, -1, 1}, {-1, 1, -1, 1}, 5)
    print(string.format('%.3f %.3f %.3f', path[1], path[5], path[10]), string.format('%.3f', times[5]))
    path, times = generate({0, 2}, {0, 1}, {-0.5, 0.5}, {-1, 1})
    print(#path, #times, string.format('%.2f', times[1000]))
    for _, boundary in ipairs{'not-a-knot', 'natural', 'clamped'} do
        path, times = generate({0, 1, 0.5, 2}, {0, 1, 2, 3}, {-1, 0.8}, {-2, 1}, 2001, boundary)
        local dt, most, least = times[2], 0, 0
        for i = 2, #path do
            local v = (path[i] - path[i - 1]) / dt
            most, least = math.max(most, v), math.min(least, v)
        end
        print(boundary, most <= 0.801, least >= -1.001, least < 0, path[#path])
    end
    refused({0, 0, 1, 1}, {0, 1}, {-1, 1}, {-1, 1, -1, 1})
    refused({0, 0, 1}, {0, 1}, {-1, 1}, {-1, 1})
    refused({0 / 0, 1}, {0, 1}, {-1, 1}, {-1, 1})
    refused({0, 1}, {0, 0}, {-1, 1}, {-1, 1})
    refused({0, 1}, {0, 1}, {0, 0}, {-1, 1})
    refused({0, 1}, {0, 1}, {1, 2}, {-1, 1})
    refused({0}, {0}, {-1, 1}, {-1, 1})
    refused({0, 1}, {0, 1}, {-1, 1}, {-1, 1}, 1)
    refused({0, 1}, {0, 1}, {-1, 1}, {-1, 1}, 10, 'loose')
end
