-- topic: modules
-- as: customization
-- passes: 0
-- loops: 4
-- spec: simui 2, simui 4, simui 5
-- note: windows without a display: names of ids, values, errors, events at the end of an iteration, dialogs
sim = require 'sim'
simUI = require 'simUI'

local function reason(f, ...)
    local ok, message = pcall(f, ...)
    return ok and 'no error' or message:gsub('^.-: in ', 'in ')
end

local function C(content) return simUI.create('<ui title="Test" on-close="closed">' .. content .. '</ui>') end

function changed(...) print('changed', select(2, ...), select(3, ...)) end

function sysCall_init()
    print(reason(simUI.create, '<ui'))
    print(reason(simUI.setTitle, 5, 'x'))
    local k = 77
    local u = C '<label id="${lab}" text="hi"/><label id="${k}"/><hslider id="5" minimum="-5" maximum="5"/>'
    print(math.type(lab), simUI.getLabelText(u, lab), simUI.getLabelText(u, 77) == '')
    simUI.setSliderValue(u, 5, 99)
    print(simUI.getSliderValue(u, 5), reason(simUI.getSliderValue, u, 99), reason(simUI.getSliderValue, u, 77))
    simUI.setTitle(u, 'Other')
    simUI.hide(u)
    print(simUI.getTitle(u), simUI.isVisible(u), simUI.getWidgetVisibility(u, 5))
    simUI.destroy(u)
    print(reason(simUI.hide, u))

    local v = C '<spinbox id="1" value="3.7"/><spinbox id="2" decimals="2" value="1.236"/><checkbox id="3" checked="true"/>'
    print(simUI.getSpinboxValue(v, 1), simUI.getSpinboxValue(v, 2), simUI.getCheckboxValue(v, 3))
    print(reason(simUI.setCheckboxValue, v, 3, 3))

    local c = C '<combobox id="1"><item>a</item><item/></combobox><combobox id="2"/>'
    print(#simUI.getComboboxItems(c, 1), simUI.getComboboxSelectedIndex(c, 1), simUI.getComboboxSelectedIndex(c, 2))
    simUI.insertComboboxItem(c, 2, 0, 'x')
    print(simUI.getComboboxSelectedIndex(c, 2))
    simUI.setComboboxItems(c, 2, {'p', 'q'}, 1)
    simUI.setComboboxSelectedIndex(c, 2, 9)
    print(simUI.getComboboxSelectedIndex(c, 2), simUI.getComboboxItemText(c, 2, 1))

    local p = C '<plot id="1" max-buffer-size="3"/>'
    print(reason(simUI.addCurve, p, 1, simUI.curve_type.time, 'a', {255, 0, 0}, simUI.curve_style.line))
    print(reason(simUI.addCurve, p, 1, simUI.curve_type.time, 'a', {255, 0, 0}, simUI.curve_style.line, {foo = 1}))
    simUI.addCurve(p, 1, simUI.curve_type.time, 'a', {255, 0, 0}, simUI.curve_style.line, {})
    print(reason(simUI.addCurveTimePoints, p, 1, 'z', {1}, {1}))
    simUI.addCurveTimePoints(p, 1, 'a', {1, 2, 3, 4, 5}, {5, 4, 3, 2, 1})
    local t, x, y = simUI.getCurveData(p, 1, 'a')
    print(#t, table.concat(x, ' '), table.concat(y, ' '))

    local s = C '<hslider id="1" on-change="changed"/><edit id="2" on-change="missing"/>'
    simUI.setSliderValue(s, 1, 10)
    simUI.setSliderValue(s, 1, 20, false)
    simUI.setSliderValue(s, 1, 20, false)
    print('events come later')

    print(simUI.msgBox(simUI.msgbox_type.info, simUI.msgbox_buttons.yesno, 'Title', 'Message'), #simUI.fileDialog(0, 'a', 'b', 'c', 'd', 'e'))
    print(simUI.colorDialog(), simUI.inputDialog(), sim.msgBox(0, 0, 'a', 'b'))
    local editor = sim.textEditorOpen('text', '<editor title="Notes" position="10 20" size="30 40"/>')
    local text, position, size, visible = sim.textEditorGetInfo(editor)
    print(text, position[1], position[2], size[1], size[2], visible)
end

local passes = 0
function sysCall_nonSimulation()
    passes = passes + 1
    print('pass', passes)
    if passes == 3 then sim.quitSimulator() end
end
