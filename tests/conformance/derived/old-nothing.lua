-- topic: old functions
-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.8
-- note: what has no effect any more, and dialogs without a display
sim = require 'sim'
print(sim.handleMechanism(1), sim.setThreadIsFree(true))
print(select('#', sim.handleMill(1)), select('#', sim.resetMill(1)))
print(sim.msgBox(sim.msgbox_type_info, sim.msgbox_buttons_yesno, 'title', 'text'))
print(sim.displayDialog('title', 'text', sim.dlgstyle_ok, false))
print(sim.getDialogResult(0), '[' .. sim.getDialogInput(0) .. ']', select('#', sim.endDialog(0)))
print(select('#', sim.fileDialog(0, 't', '', '', 'e', 'e')))
print(sim.auxiliaryConsoleOpen('c', 10, 0), sim.auxiliaryConsolePrint(1, 'x'), sim.auxiliaryConsoleShow(1, true), sim.auxiliaryConsoleClose(1))
print(sim.addStatusbarMessage(nil), sim.addStatusbarMessage())
print(sim.handleCollision(sim.handle_all), sim.resetCollision(sim.handle_all), sim.handleDistance(sim.handle_all), sim.resetDistance(sim.handle_all))
