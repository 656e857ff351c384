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
-- @return result 0
function M.handleMechanism(mechanismHandle) return 0 end

--- Does nothing: IK groups of the scene are gone, simIK is for that.
-- @api int result = sim.handleIkGroup(int ikGroupHandle)
-- @param ikGroupHandle any
-- @return result 0
function M.handleIkGroup(ikGroupHandle) return 0 end

--- Handle of an IK group of the scene; there are none.
-- @api int handle = sim.getIkGroupHandle(string ikGroupName)
-- @param ikGroupName its name
-- @return handle -1
function M.getIkGroupHandle(ikGroupName) return -1 end

--- Does nothing: mills are gone.
-- @api int result = sim.handleMill(int millHandle)
-- @param millHandle any
-- @return result 0
function M.handleMill(millHandle) return 0 end

--- Does nothing: mills are gone.
-- @api int result = sim.resetMill(int millHandle)
-- @param millHandle any
-- @return result 0
function M.resetMill(millHandle) return 0 end

--- Does nothing: mills are gone.
-- @api int result = sim.resetMilling(int objectHandle)
-- @param objectHandle any
-- @return result 0
function M.resetMilling(objectHandle) return 0 end

--- Does nothing: kinematic joints move by sim.handleJointMotion.
-- @api int result = sim.handleJoint(int jointHandle, float deltaTime)
-- @param jointHandle any
-- @param deltaTime seconds
-- @return result 0
function M.handleJoint(jointHandle, deltaTime) return 0 end

--- Does nothing.
-- @api int result = sim.handleVarious()
-- @return result 0
function M.handleVarious() return 0 end

--- Does nothing: what there is to calculate is calculated.
-- @api int result = sim.enableWorkThreads(int count)
-- @param count of threads
-- @return result 0
function M.enableWorkThreads(count) return 0 end

--- Does nothing.
-- @api int result = sim.waitForWorkThreads()
-- @return result 0
function M.waitForWorkThreads() return 0 end

--- Does nothing: threads are coroutines, which their scripts resume.
-- @api int count = sim.resumeThreads(int location)
-- @param location sim.scriptthreadresume_*
-- @return count 0
function M.resumeThreads(location) return 0 end

--- Does nothing: threads are coroutines, which their scripts resume.
-- @api int count = sim.launchThreadedChildScripts()
-- @return count 0
function M.launchThreadedChildScripts() return 0 end

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

--- Name of a native plugin; there are none.
-- @api string pluginName = sim.getPluginName(int index)
-- @param index from 0
-- @return pluginName nil
function M.getPluginName(index) return nil end

--- Name of a native plugin; there are none.
-- @api string moduleName = sim.getModuleName(int index)
-- @param index from 0
-- @return moduleName nil
function M.getModuleName(index) return nil end

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

--- A message in a window. There are no windows.
-- @api int handle = sim.displayDialog(string title, string text, int style, bool modal, ...)
-- @param title of the window
-- @param text in it
-- @param style sim.dlgstyle_*
-- @param modal whether to wait
-- @return handle -1
function M.displayDialog(title, text, style, modal, ...) return -1 end

--- Closes a window of sim.displayDialog.
-- @api int result = sim.endDialog(int handle)
-- @param handle from sim.displayDialog
-- @return result 0
function M.endDialog(handle) return 0 end

--- The user's choice; there is none.
-- @api int result = sim.getDialogResult(int handle)
-- @param handle from sim.displayDialog
-- @return result sim.dlgret_still_open
function M.getDialogResult(handle) return sim.dlgret_still_open end

--- A message with buttons, as simUI.msgBox.
-- @api int returnValue = sim.msgBox(int dlgType, int buttons, string title, string message)
-- @param dlgType sim.msgbox_type_*
-- @param buttons sim.msgbox_buttons_*
-- @param title of the window
-- @param message in it
-- @return returnValue sim.msgbox_return_*
function M.msgBox(dlgType, buttons, title, message)
    return require('simUI').msgBox(dlgType, buttons, title, message)
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
    local files = require('simUI').fileDialog(mode, title, startPath, initName, extName, ext)
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
