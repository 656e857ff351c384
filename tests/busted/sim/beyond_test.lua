-- Where assertions do more than the original, which fails on these or ignores them.
require 'swanilda.test'

describe('assertions', function()
    it('take the level of the one to blame', function()
        local function helper(x) assert.are.equal(1, x, 'the message', assert:level(2)) end
        local passed, problem = pcall(function()
            helper(2)
        end)
        assert.is_false(passed)
        assert.matches(':8: the message', tostring(problem))
    end)

    it('blame the caller for wrong arguments', function()
        local _, problem = pcall(function() assert.near(1, 2) end)
        assert.matches("beyond_test%.lua:15: the 'near' function requires a minimum of 3 arguments", tostring(problem))
    end)

    it('mark the first difference in the order shown', function()
        local _, problem = pcall(function() assert.same({a = 1, b = 2, c = 3}, {a = 1, b = 3, c = 4}) end)
        assert.matches('%*%[b%] = 3', tostring(problem))
        assert.not_matches('%*%[c%]', tostring(problem))
    end)

    it('show tables that contain themselves when there is no limit', function()
        local t = {}
        t.self = t
        local snapshot = assert:snapshot()
        assert:set_parameter('TableFormatLevel', -1)
        local _, problem = pcall(function() assert.is_nil(t) end)
        snapshot:revert()
        assert.matches('recursive', tostring(problem))
    end)
end)

describe('match._', function()
    it('has a text', function()
        local s = spy.new(function() end)
        s()
        local _, problem = pcall(function() assert.spy(s).was.called_with(match._) end)
        assert.matches('%(matcher%) _', tostring(problem))
    end)
end)

describe('a snapshot', function()
    it('takes back the newest first', function()
        local function f() end
        local t = {f = f}
        local snapshot = assert:snapshot()
        stub(t, 'f')
        spy.on(t, 'f')
        snapshot:revert()
        assert.are.equal(f, t.f)
    end)
end)

describe('spies', function()
    it('leave nothing of what a table inherits', function()
        local t = setmetatable({}, {__index = {f = function() return 'inherited' end}})
        spy.on(t, 'f'):revert()
        assert.is_nil(rawget(t, 'f'))
        assert.are.equal('inherited', t.f())
    end)

    it('go where a table puts its elements', function()
        local elements = {f = function() return 'element' end}
        local t = setmetatable({}, {__index = elements, __newindex = elements})
        local s = spy.on(t, 'f')
        assert.are.equal(s, elements.f)
        s:revert()
        assert.are.equal('element', t.f())
    end)

    it('do not copy objects with a finalizer', function()
        local finalized = 0
        local object = setmetatable({}, {__gc = function() finalized = finalized + 1 end})
        local s = spy.new(function() end)
        s(object)
        assert.are.equal(object, s.calls[1].vals[1])
    end)
end)

describe('mocks', function()
    it('may contain themselves', function()
        local function f() end
        local t = {f = f}
        t.self = t
        mock(t)
        assert.is_true(spy.is_spy(t.f))
        mock.clear(t)
        mock.revert(t)
        assert.are.equal(f, t.f)
    end)
end)
