-- topic: threads
-- as: customization
-- passes: 4
-- spec: threads 3
-- note: loading sim without require uses up the slice of a coroutine, but not at once: the next statements still run, as the stock Stewart platform needs
function sysCall_init() co = coroutine.create(main) end

function main()
    local time = sim.getSimulationTime()
    isReady = true
    for _ = 1, 200 do time = time + 1 end
    isLate = true
    while true do coroutine.yield() end
end

function sysCall_actuation()
    coroutine.resume(co)
    print(isReady, isLate)
end
