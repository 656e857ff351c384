--[[
A window for an oscillator: a button starts and stops it, a slider sets its frequency, a plot shows it.

    swanilda view scenes/panel.lua      opens the window in a browser
    swanilda test scenes/tests          presses its buttons without one
]]

sim = require 'sim'
simUI = require 'simUI'

local WINDOW = [[
<ui title="Oscillator" closeable="false" resizable="true" placement="relative" position="50,50">
    <group layout="form" flat="true">
        <label text="Frequency:"/>
        <hslider id="${frequency}" minimum="1" maximum="20" value="5" on-change="setFrequency"/>
        <label text="Name:"/>
        <edit id="${title}" value="wave" on-editing-finished="rename"/>
    </group>
    <label id="${status}" text="stands still"/>
    <button id="${button}" text="Start" checkable="true" on-click="toggle"/>
    <plot id="${plot}" max-buffer-size="200" cyclic-buffer="true"/>
</ui>
]]

local phase, hertz, runs, curve = 0, 0.5, false, 'wave'

local function addCurve()
    simUI.addCurve(ui, plot, simUI.curve_type.time, curve, {0, 120, 200}, simUI.curve_style.line, {})
end

function sysCall_init()
    ui = simUI.create(WINDOW)
    simUI.setPlotLabels(ui, plot, 'time (s)', 'value')
    simUI.setLegendVisibility(ui, plot, true)
    addCurve()
    print('The oscillator stands still until its button is pressed.')
end

function setFrequency(_, _, value) hertz = value / 10 end

function rename(_, _, text)
    if text == '' or text == curve then return end
    simUI.removeCurve(ui, plot, curve)
    curve = text
    addCurve()
end

function toggle()
    runs = not runs
    simUI.setButtonText(ui, button, runs and 'Stop' or 'Start')
    simUI.setLabelText(ui, status, runs and 'runs' or 'stands still')
end

function sysCall_sensing()
    if not runs then return end
    phase = phase + 2 * math.pi * hertz * sim.getSimulationTimeStep()
    simUI.addCurveTimePoints(ui, plot, curve, {sim.getSimulationTime()}, {math.sin(phase)})
    simUI.rescaleAxes(ui, plot, curve)
    simUI.replot(ui, plot)
end
