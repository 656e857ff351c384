-- topic: modules
-- as: customization
-- passes: 0
-- spec: libraries 2
-- note: code as the user would run it; what is about the window has no effect
sim = require 'sim'
simCmd = require 'simCmd'
function sysCall_init()
    simCmd.exec('Lua', '1 + 1')
    simCmd.exec('Lua', 'x = 5')
    print(x)
    simCmd.exec('Lua', 'x, "a@b"')
    simCmd.setSelectedScript(sim.getScript(sim.handle_self))
    simCmd.exec('lua', 'x = 6')
    print(x)
    print(pcall(simCmd.exec, 'Python', '1'))
    print(pcall(simCmd.exec, 'Lua') == false, pcall(simCmd.exec, 'Lua', 'error()') == false)
    print(simCmd.setVisible(true), simCmd.clearHistory(), simCmd.toggleStatusbarHeight(), simCmd.helpClose())
    print(#simCmd.helpText() > 0)
    -- Every line of the text is printed.
    simCmd.help()
end
