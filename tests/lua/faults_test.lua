-- Each fault of t.faults, by what a script of the scene notices of it.

local sim = require('sim')
local t = require('swanilda.test')

local function script(code)
    local handle = sim.createScript(sim.scripttype_simulation, "sim = require 'sim'\n" .. code)
    t.start()
    return t.script(handle)
end

local function body(mass)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, { 0.2, 0.2, 0.2 })
    sim.setObjectPosition(shape, { 0, 0, 5 })
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setShapeMass(shape, mass)
    return shape
end

local function readings(s, n)
    local values = {}
    for i = 1, n do values[i] = s:call('again') end
    return values
end

describe('sensors', function()
    local s
    before_each(function()
        s = script('value = 0 function read() value = value + 1 return value, "text" end function again() return (read()) end')
    end)

    it('are noisy', function()
        t.faults.noise(s, 'read', 0.1)
        local sum, squares = 0, 0
        for i, value in ipairs(readings(s, 200)) do
            sum, squares = sum + (value - i), squares + (value - i) ^ 2
        end
        assert.near(0, sum / 200, 0.03)
        assert.near(0.1, math.sqrt(squares / 200), 0.02)
    end)

    it('are shifted until that stops', function()
        local fault = t.faults.bias(s, 'read', 10)
        assert.are.same({ 11, 12 }, readings(s, 2))
        fault:stop()
        assert.are.same({ 3, 4 }, readings(s, 2))
    end)

    it('see nothing now and then', function()
        t.faults.dropout(s, 'read', 0.5, -1)
        local lost = 0
        for _, value in ipairs(readings(s, 200)) do lost = lost + (value == -1 and 1 or 0) end
        assert.is_true(lost > 60 and lost < 140, lost)
    end)

    it('are stuck', function()
        readings(s, 2)
        local fault = t.faults.stuck(s, 'read')
        assert.are.same({ 3, 3, 3 }, readings(s, 3))
        fault:stop()
        assert.are.same({ 4 }, readings(s, 1))
    end)

    it('are dark', function()
        s:run('function picture() return "\\1\\2\\3", {1, 1} end function seen() return picture() end')
        t.faults.blackout(s, 'picture')
        local picture, size = s:call('seen')
        assert.are.equal('\0\0\0', picture)
        assert.are.same({ 1, 1 }, size)
    end)
end)

describe('messages', function()
    local s
    before_each(function() s = script('got = {} function send(n) got[#got + 1] = n end function say(n) send(n) end') end)

    local function say(n)
        for i = 1, n do s:call('say', i) end
        return s:get('got')
    end

    it('are late', function()
        t.faults.delay(s, 'send', 0.1)
        assert.are.same({}, say(2))
        t.step(3)
        assert.are.same({ 1, 2 }, s:get('got'))
    end)

    it('are lost', function()
        local fault = t.faults.lose(s, 'send')
        say(2)
        fault:stop()
        assert.are.same({ 1 }, say(1))
    end)

    it('come twice', function()
        t.faults.double(s, 'send')
        assert.are.same({ 1, 1, 2, 2 }, say(2))
    end)

    it('come after the next one', function()
        local fault = t.faults.reorder(s, 'send')
        assert.are.same({ 2, 1 }, say(3))
        fault:stop()
        assert.are.same({ 2, 1, 3 }, s:get('got'))
    end)
end)

describe('programs', function()
    it('are slow', function()
        local s = script('n = 0 function sysCall_actuation() n = n + 1 end')
        local before = s:get('n')
        t.faults.slow(s, 'sysCall_actuation', 3)
        t.step(9)
        assert.are.equal(before + 3, s:get('n'))
    end)

    it('fail once', function()
        t.allow_script_errors()
        local s = script('n = 0 function work() n = n + 1 end function try() return pcall(work) end')
        t.faults.fail(s, 'work', 'no power')
        assert.is_false((s:call('try')))
        assert.is_true((s:call('try')))
        assert.are.equal(1, s:get('n'))
        assert.are.equal(1, #t.logs('no power'))
    end)

    it('crash', function()
        local s = script('n = 0 function sysCall_actuation() n = n + 1 print(n) end')
        t.step(2)
        local before = #t.prints()
        t.faults.crash(s)
        t.step(3)
        assert.are.equal(before, #t.prints())
    end)
end)

describe('motors', function()
    it('have backlash', function()
        local s = script('got = {} function set(h, v) got[#got + 1] = v end function drive(v) set(1, v) end')
        t.faults.backlash(s, 'set', 0.2)
        for _, command in ipairs { 0, 1, 0.95, 0.5, 1 } do s:call('drive', command) end
        local expected = { 0, 0.9, 0.9, 0.6, 0.9 }
        for i, value in ipairs(s:get('got')) do assert.near(expected[i], value, 1e-12) end
    end)

    local function joint()
        local base, link = body(10), body(0.1)
        sim.setBoolProperty(base, 'dynamic', false)
        local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
        sim.setObjectPosition(handle, { 0, 0, 5.5 })
        sim.setObjectParent(handle, base, true)
        sim.setObjectPosition(link, { 0, 0, 6 })
        sim.setObjectParent(link, handle, true)
        sim.setObjectInt32Param(handle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
        sim.setJointTargetForce(handle, 100)
        sim.setJointTargetVelocity(handle, 1)
        return handle
    end

    it('are jammed until that stops', function()
        local handle = joint()
        t.run_for(0.5)
        local fault = t.faults.jam(handle)
        local at = sim.getJointPosition(handle)
        t.run_for(1)
        assert.near(at, sim.getJointPosition(handle), 0.02)
        fault:stop()
        t.run_for(1)
        assert.is_true(sim.getJointPosition(handle) > at + 0.5)
    end)

    it('are weak', function()
        local handle = joint()
        local fault = t.faults.weak(handle, 0.25)
        assert.are.equal(25.0, sim.getJointTargetForce(handle))
        fault:stop()
        assert.are.equal(100.0, sim.getJointTargetForce(handle))
    end)
end)

describe('bodies', function()
    it('are heavier', function()
        local shape = body(2)
        local inertia = sim.getShapeInertia(shape)
        local fault = t.faults.mass(shape, 1.5)
        assert.near(3, sim.getShapeMass(shape), 1e-9)
        assert.near(1.5 * inertia[1], sim.getShapeInertia(shape)[1], 1e-9)
        fault:stop()
        assert.near(2, sim.getShapeMass(shape), 1e-9)
    end)

    -- An impulse of 2 N for 0.5 s on 2 kg.
    it('are pushed in the frame of the world', function()
        local shape = body(2)
        sim.setObjectOrientation(shape, { 0, 0, 1 })
        t.start()
        t.faults.push(shape, { 2, 0, 0 }, 0.5)
        t.run_for(1)
        local velocity = sim.getVelocity(shape)
        assert.near(0.5, velocity[1], 0.01)
        assert.near(0, velocity[2], 0.01)
    end)

    it('slip', function()
        local shape = body(1)
        local before = sim.getFloatProperty(shape, 'bullet.friction')
        local fault = t.faults.slip(shape, 0.1)
        assert.near(before * 0.1, sim.getFloatProperty(shape, 'bullet.friction'), 1e-9)
        fault:stop()
        assert.near(before, sim.getFloatProperty(shape, 'bullet.friction'), 1e-9)
    end)
end)
