--[[
Functions of sim that have no effect in CoppeliaSim any more but are called by old main scripts and models. Also dialogs and plugins
of old scripts, which do not exist without a display.

Deprecation notices are native.
]]

local sim = ...
local M = {}

--- Does nothing: mechanisms are gone.
-- @api int result = sim.handleMechanism(int mechanismHandle)
-- @param mechanismHandle any
-- @return result -1
function M.handleMechanism(mechanismHandle) return -1 end

--- Does nothing: mills are gone.
-- @api sim.handleMill(int millHandle)
-- @param millHandle any
function M.handleMill(millHandle) end

--- Does nothing: mills are gone.
-- @api sim.resetMill(int millHandle)
-- @param millHandle any
function M.resetMill(millHandle) end

--- Does nothing: mills are gone.
-- @api sim.resetMilling(int objectHandle)
-- @param objectHandle any
function M.resetMilling(objectHandle) end

--- Does nothing.
-- @api int result = sim.handleVarious()
-- @return result 1
function M.handleVarious() return 1 end

--- Does nothing: what there is to calculate is calculated.
-- @api int result = sim.enableWorkThreads(int count)
-- @param count of threads
-- @return result 0
function M.enableWorkThreads(count) return 0 end

--- Does nothing.
-- @api int result = sim.waitForWorkThreads()
-- @return result 0
function M.waitForWorkThreads() return 0 end

--- Does nothing: a thread never runs while the simulation does something else.
-- @api int result = sim.setThreadIsFree(bool freeMode)
-- @param freeMode any
-- @return result 0
function M.setThreadIsFree(freeMode) return 0 end

--- Does nothing: there are no plugins to notify.
-- @api int count = sim.openModule(any module)
-- @param module a name, or sim.handle_all
-- @return count 0
function M.openModule(module) return 0 end

--- Does nothing: there are no plugins to notify.
-- @api int count = sim.closeModule(any module)
-- @param module a name, or sim.handle_all
-- @return count 0
function M.closeModule(module) return 0 end

--- Does nothing: there are no plugins to notify.
-- @api int count = sim.handleModule(any module, bool calledInSensingPart)
-- @param module a name, or sim.handle_all
-- @param calledInSensingPart any
-- @return count 0
function M.handleModule(module, calledInSensingPart) return 0 end

--- Tests of the original's developers: there are none here.
-- @api sim.test(string cmd, ...)
-- @param cmd any
function M.test(cmd, ...) end

--- The inverse of a matrix.
-- @api float[12] inverse = sim.getInvertedMatrix(float[12] matrix)
-- @param matrix 3 rows of 4
-- @return inverse another table
function M.getInvertedMatrix(matrix) return sim.getMatrixInverse(matrix) end

--- Milliseconds of wall-clock time.
-- @api int time = sim.getSystemTimeInMilliseconds(int before = 0)
-- @param before a time to count from
-- @return time since then
function M.getSystemTimeInMilliseconds(before) return math.floor(sim.getSystemTime() * 1000) - (before or 0) end

---------------------------------------------------------------- dialogs

--- A message with buttons, as simUI.msgBox; without a person the answer is ok.
-- @api int returnValue = sim.msgBox(int dlgType, int buttons, string title, string message)
-- @param dlgType sim.msgbox_type_*
-- @param buttons sim.msgbox_buttons_*
-- @param title of the window
-- @param message in it
-- @return returnValue sim.msgbox_return_*
function M.msgBox(dlgType, buttons, title, message)
    return require('simUI')._simMsgBox(dlgType, buttons, title, message)
end

--- Asks for a file, as simUI.fileDialog.
-- @api string pathAndName = sim.fileDialog(int mode, string title, string startPath, string initName, string extName, string ext)
-- @param mode sim.filedlg_type_*
-- @param title of the window
-- @param startPath the folder to begin with
-- @param initName the name to begin with
-- @param extName what the extensions are called
-- @param ext extensions without dots, with semicolons between them
-- @return pathAndName nil if cancelled; several with semicolons between them
function M.fileDialog(mode, title, startPath, initName, extName, ext)
    local files = require('simUI')._simFileDialog(title)
    if #files > 0 then return table.concat(files, ';') end
end

---------------------------------------------------------------- wireless messages of V-REP

-- Signals live as long as the script that set them.
local function mailbox(header, name)
    local plain = name:gsub('%W', function(letter) return '_' .. letter:byte() end)
    return 'signal.wireless_' .. math.floor(header) .. '_' .. plain
end

--- Leaves data for other scripts. Distances and directions of antennas do not count.
-- @api sim.sendData(int targetID, int dataHeader, string dataName, string data, ...)
-- @param targetID any
-- @param dataHeader number both sides know
-- @param dataName name both sides know
-- @param data bytes
function M.sendData(targetID, dataHeader, dataName, data, ...)
    sim.setBufferProperty(sim.handle_scene, mailbox(dataHeader, dataName), data)
end

--- Receives data sent by sim.sendData.
-- @api string data, int senderID, int dataHeader, string dataName = sim.receiveData(int dataHeader, string dataName, ...)
-- @param dataHeader as sent
-- @param dataName as sent
-- @return data nil when there is nothing
-- @return senderID -1
-- @return dataHeader as sent
-- @return dataName as sent
function M.receiveData(dataHeader, dataName, ...)
    local box = mailbox(dataHeader, dataName)
    local data = sim.getBufferProperty(sim.handle_scene, box, {noError = true})
    if data == nil then return nil end
    sim.removeProperty(sim.handle_scene, box)
    return tostring(data), -1, dataHeader, dataName
end

return M
