-- The window of the oscillator.
local sim = require 'sim'
local simUI = require 'simUI'
local t = require 'swanilda.test'

describe('the panel', function()
    local w

    before_each(function()
        t.load('../panel.lua')
        w = t.ui('Oscillator')
    end)

    it('starts and stops with a button', function()
        t.step(5)
        assert.are.equal('stands still', w:value('status'))
        w:click('Start')
        assert.are.equal('runs', w:value('status'))
        t.step(40)
        w:click('Stop')
        local _, times, values = simUI.getCurveData(w.handle, w:id('plot'), 'wave')
        assert.are.equal(40, #times)
        local highest = math.max(table.unpack(values))
        assert.is_true(highest > 0.99 and highest <= 1)
    end)

    it('oscillates as fast as the slider says', function()
        w:set('Frequency', 20)
        w:click('Start')
        t.step(10)
        local _, _, values = simUI.getCurveData(w.handle, w:id('plot'), 'wave')
        assert.is_true(math.abs(values[10] - math.sin(2 * math.pi * 2 * 10 * 0.05)) < 1e-9)
    end)

    it('renames its curve when the name was entered', function()
        w:set('Name', 'sine')
        assert.has_no.errors(function() simUI.getCurveData(w.handle, w:id('plot'), 'wave') end)
        w:enter('Name', 'sine')
        assert.has_no.errors(function() simUI.getCurveData(w.handle, w:id('plot'), 'sine') end)
    end)

    it('says what there is when a name is wrong', function()
        local ok, message = pcall(w.click, w, 'Begin')
        assert.is_false(ok)
        assert.is_truthy(message:find("window 'Oscillator' has no widget 'Begin'", 1, true))
        assert.is_truthy(message:find("button 'button'", 1, true))
        assert.is_truthy(select(2, pcall(t.ui, 'Robot')):find("there are: 'Oscillator'", 1, true))
    end)
end)
