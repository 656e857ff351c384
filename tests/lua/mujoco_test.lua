-- simMujoco: what injections become, what of them is named, and when they go (spec: simmujoco 1).
local t = require 'swanilda.test'

local function near(expected, value, tolerance) assert.is_true(math.abs(value - expected) < tolerance, value .. ' is not ' .. expected) end

local function height(list, node) return list[3 * node + 3] end

-- A 5 by 5 net of edges in the world, at a height of a metre.
local function net(changes)
    local info = {
        element = 'worldbody', name = 'net', type = 'grid', count = {5, 5, 1}, spacing = {0.1, 0.1, 0.1}, radius = 0.005, mass = 0.25,
        pose = {0, 0, 1, 0, 0, 0, 1}, extraXml = '<edge equality="true"/>',
    }
    -- False: without it.
    for key, value in pairs(changes or {}) do info[key] = value or nil end
    return info
end

describe('an injection', function()
    local box

    before_each(function()
        sim = require 'sim'
        simMujoco = require 'simMujoco'
        box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(box, 'crate')
        sim.setObjectPosition(box, {0, 0, 2})
    end)

    it('of a flexcomp hangs where it is pinned', function()
        local id = simMujoco.addFlexcomp(net {pin = {0, 4, 20, 24}})
        assert.same({}, simMujoco.getFlexcompInfo(id, 0))
        t.run_for(1)
        local info = simMujoco.getFlexcompInfo(id, 0)
        assert.same({5, 5, 1}, info.count)
        assert.equal(75, #info.positions)
        near(1, height(info.positions, 0), 1e-6)
        near(-0.2, info.positions[1], 1e-6)
        assert.is_true(height(info.positions, 12) < 0.995, height(info.positions, 12))
        assert.is_true(height(info.positions, 12) > 0.9, height(info.positions, 12))
        assert.equal(32 * 9, #simMujoco.getFlexcompInfo(id, 1).triangles)
    end)

    it('is on a shape, and is carried by it', function()
        local id = simMujoco.addFlexcomp(net {element = false, shapeHandle = box, pose = {0.2, 0, 0, 0, 0, 0, 1}, pin = {0, 1, 2, 3, 4}})
        t.run_for(0.1)
        near(2, height(simMujoco.getFlexcompInfo(id, 0).positions, 0), 1e-6)
        sim.setObjectPosition(box, {0, 0, 2.1})
        t.run_for(0.1)
        near(2.1, height(simMujoco.getFlexcompInfo(id, 0).positions, 2), 1e-6)
    end)

    it('calls back when it becomes objects, and takes what it is told', function()
        local calls = {}
        local id = simMujoco.addFlexcomp(net {callback = function(info)
            calls[#calls + 1] = info.name
            return {count = {3, 3, 1}}
        end})
        assert.same({}, calls)
        t.run_for(0.1)
        assert.same({'net'}, calls)
        assert.same({3, 3, 1}, simMujoco.getFlexcompInfo(id, 0).count)
    end)

    it('is a rope, a cloth or a volume by its count', function()
        local rope = simMujoco.addFlexcomp(net {name = 'rope', count = {9, 1, 1}})
        local block = simMujoco.addFlexcomp(net {
            name = 'block', count = {3, 3, 3}, extraXml = '<elasticity young="1e5" poisson="0.3"/>', extraFlexcompXml = 'dim="3" rgba="1 0 0 1"',
        })
        t.run_for(0.05)
        assert.equal(27, #simMujoco.getFlexcompInfo(rope, 0).positions)
        assert.equal(81, #simMujoco.getFlexcompInfo(block, 0).positions)
        assert.equal(48 * 9, #simMujoco.getFlexcompInfo(block, 1).triangles)
    end)

    it('of a cable has poses along it', function()
        local xml = [[<composite type="cable" curve="s" count="11 1 1" size="0.5" offset="0 0 1" initial="none">
            <joint kind="main" damping="0.001"/><geom type="capsule" size="0.005"/>
            <plugin plugin="mujoco.elasticity.cable"><config key="twist" value="1e7"/><config key="bend" value="2e7"/></plugin>
        </composite>]]
        local id = simMujoco.composite(xml, {element = 'worldbody', prefix = 'hose', type = 'cable', count = {11, 1, 1}, grow = 0.01, respondableMask = 0})
        t.run_for(1)
        local positions = simMujoco.getCompositeInfo(id, 0).positions
        near(1, height(positions, 0), 1e-6)
        near(1, height(positions, 1), 1e-3)
        assert.is_true(height(positions, 10) < 0.95, height(positions, 10))
        local poses = simMujoco.getCompositeInfo(id, 1).poses
        assert.equal(77, #poses)
        -- The second link points along x, the last one downwards.
        local matrix = sim.poseToMatrix {table.unpack(poses, 71, 77)}
        assert.is_true(matrix[9] < -0.05, matrix[9])
        local own, grown = simMujoco.getCompositeInfo(id, 2).triangles, simMujoco.getCompositeInfo(id, 3).triangles
        assert.equal(#own, #grown)
        local function half(list)
            local low, high = math.huge, -math.huge
            for i = 2, #list, 3 do low, high = math.min(low, list[i]), math.max(high, list[i]) end
            return (high - low) / 2
        end
        near(0.005, half(own), 5e-4)
        near(0.015, half(grown), 1.5e-3)
        assert.equal(0, sim.getObjectInt32Param(sim.getObject('/hose'), sim.shapeintparam_respondable_mask))
    end)

    it('of constraints holds nodes and shapes', function()
        sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
        local xml = [[<worldbody>
            <composite prefix="rope" type="cable" count="6 1 1" size="0.5" offset="0 0 2.5"><geom size="0.005"/></composite>
        </worldbody>
        <equality><connect body1="ropeB_last" body2="crate" anchor="0.1 0 0"/></equality>]]
        simMujoco.addInjection {element = 'mujoco', xml = xml}
        local other = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(other, 'other')
        sim.setObjectPosition(other, {1, 0, 2})
        sim.setObjectInt32Param(other, sim.shapeintparam_static, 0)
        simMujoco.addInjection {element = 'equality', xml = '<weld body1="other" body2="crate"/>'}
        local held = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(held, 'held')
        sim.setObjectPosition(held, {0, 3, 2})
        sim.setObjectInt32Param(held, sim.shapeintparam_static, 0)
        simMujoco.addInjection {element = 'equality', xml = '<connect body1="held" anchor="0 0 0.5"/>'}
        t.run_for(0.5)
        -- Both are carried by the rope: the crate at its corner does not fall, and the other one goes along.
        assert.is_true(sim.getObjectPosition(box)[3] > 1, sim.getObjectPosition(box)[3])
        local between = sim.getObjectPosition(other, box)
        near(1, between[1], 1e-3)
        near(0, between[3], 1e-3)
        near(2, sim.getObjectPosition(held)[3], 1e-3)
    end)

    it('of options changes the scene as long as it is there', function()
        local before = sim.getArrayParam(sim.arrayparam_gravity)
        local id = simMujoco.addInjection {element = 'mujoco', xml = '<option gravity="0 0 -1" timestep="0.01"/>'}
        t.run_for(0.1)
        assert.same({0, 0, -1}, sim.getArrayParam(sim.arrayparam_gravity))
        near(0.01, sim.getFloatParam(sim.floatparam_physicstimestep), 1e-9)
        simMujoco.removeInjection(id)
        assert.same(before, sim.getArrayParam(sim.arrayparam_gravity))
    end)

    it('of a tendon lets the heavier mass lift the lighter one', function()
        -- Atwood's machine over two sliders: a = g (m1 - m2) / (m1 + m2).
        local function slider(name, x, mass)
            local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
            sim.setObjectPosition(base, {x, 5, 3})
            local joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
            sim.setObjectAlias(joint, name)
            sim.setJointInterval(joint, false, {-5, 10})
            sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_free)
            sim.setObjectParent(joint, base, false)
            local body = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
            sim.setObjectInt32Param(body, sim.shapeintparam_static, 0)
            sim.setShapeMass(body, mass)
            sim.setObjectParent(body, joint, false)
            return joint
        end
        local one, two = slider('one', 0, 2), slider('two', 1, 1)
        local id = simMujoco.addInjection {
            element = 'tendon', xml = '<fixed name="rope" range="0 0"><joint joint="one" coef="1"/><joint joint="two" coef="1"/></fixed>',
        }
        t.run_for(0.5)
        near(9.81 / 3 * 0.125, sim.getJointPosition(two), 0.03)
        near(0, sim.getJointPosition(one) + sim.getJointPosition(two), 1e-6)
        simMujoco.removeInjection(id)
        assert.equal(-1, sim.getObject('/rope', {noError = true}))
    end)

    it('of a string with a motor between sites pulls a body up', function()
        sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
        sim.setShapeMass(box, 1)
        simMujoco.addInjection {element = 'worldbody', xml = '<site name="top" pos="0 0 5"/>'}
        simMujoco.addInjection {shapeHandle = box, xml = '<site name="hook"/>'}
        simMujoco.addInjection {
            element = 'mujoco',
            xml = '<actuator><motor tendon="string" ctrlrange="-100 0"/></actuator><tendon><spatial name="string"><site site="top"/><site site="hook"/></spatial></tendon>',
        }
        t.run_for(0.05)
        sim.setFloatProperty(sim.getObject('/string'), 'customData.targetForce', -9.81 - 2)
        local before = sim.getObjectPosition(box)[3]
        t.run_for(0.5)
        -- It has fallen freely for a step.
        near(-9.81 * 0.05 * 0.5 + 2 * 0.125, sim.getObjectPosition(box)[3] - before, 0.01)
    end)

    it('of contacts and joints changes what there is, and sets it back', function()
        local floor = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {2, 2, 0.1})
        sim.setObjectAlias(floor, 'ground')
        sim.setObjectPosition(floor, {0, 0, 1.9})
        for _, shape in ipairs {floor, box} do sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1) end
        sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
        local id = simMujoco.addInjection {element = 'contact', xml = '<exclude body1="crate" body2="ground"/>'}
        t.run_for(0.3)
        assert.is_true(sim.getObjectPosition(box)[3] < 1.7, sim.getObjectPosition(box)[3])
        simMujoco.removeInjection(id)
        sim.setObjectPosition(box, {0, 0, 2})
        t.run_for(0.3)
        near(2, sim.getObjectPosition(box)[3], 1e-2)

        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
        sim.setObjectAlias(joint, 'hinge')
        id = simMujoco.addInjection {element = 'worldbody', xml = '<joint name="hinge" armature="0.5" damping="2"/>'}
        t.run_for(0.05)
        assert.equal(0.5, sim.getFloatProperty(joint, 'mujoco.armature'))
        assert.equal(2, sim.getFloatProperty(joint, 'mujoco.springDamping'))
        simMujoco.removeInjection(id)
        assert.equal(0, sim.getFloatProperty(joint, 'mujoco.armature'))
    end)

    it('of adhesion lets a shape hang under another one', function()
        local ceiling = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {2, 2, 0.1})
        sim.setObjectPosition(ceiling, {0, 0, 2.1})
        for _, shape in ipairs {ceiling, box} do sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1) end
        sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
        sim.setShapeMass(box, 1)
        simMujoco.addInjection {element = 'actuator', xml = '<adhesion body="crate" gain="10" ctrlrange="0 5"/>'}
        sim.setFloatProperty(box, 'mujoco.adhesionctrl', 2)
        t.run_for(0.5)
        near(2, sim.getObjectPosition(box)[3], 5e-3)
    end)

    it('names what has no counterpart, once', function()
        simMujoco.injectXML('<sensor/><tendon><fixed><joint joint="nowhere" coef="1"/></fixed></tendon><option integrator="RK4"/>', 'mujoco')
        simMujoco.addInjection {shapeHandle = box, xml = '<geom size="1"/><geom size="2"/>'}
        t.run_for(0.2)
        local texts = {}
        for _, line in ipairs(t.logs 'simMujoco') do texts[#texts + 1] = line.text end
        assert.equal(4, #texts, table.concat(texts, '; '))
        local names = {'<tendon> (it is over what is not there) of injection 1', '<sensor> of injection 1', '<option integrator> of injection 1', '<geom> of injection 2'}
        for i, name in ipairs(names) do
            assert.is_truthy(texts[i]:find(name .. ' has no counterpart, and is ignored', 1, true), texts[i])
        end
    end)

    it('goes with removeInjection and at the end', function()
        local id = simMujoco.addFlexcomp(net())
        t.run_for(0.1)
        assert.is_true(sim.getObject('/net', {noError = true}) >= 0)
        simMujoco.removeInjection(id)
        assert.equal(-1, sim.getObject('/net', {noError = true}))
        assert.has_error(function() simMujoco.getFlexcompInfo(id, 0) end)
        assert.has_error(function() simMujoco.removeInjection(id) end)
        id = simMujoco.addFlexcomp(net())
        t.run_for(0.1)
        t.stop()
        assert.equal(-1, sim.getObject('/net', {noError = true}))
        assert.same({}, simMujoco.getFlexcompInfo(id, 0))
        t.run_for(0.1)
        assert.is_true(sim.getObject('/net', {noError = true}) >= 0)
    end)

    it('lists bodies', function()
        local id = simMujoco.addFlexcomp(net())
        t.run_for(0.05)
        local text = simMujoco.getInfo('nameAndIds')
        assert.is_truthy(text:find('crate\t' .. box .. '\n', 1, true), text)
        assert.is_truthy(simMujoco.getInfo('bodies'):find('net\n', 1, true))
        simMujoco.removeXML(id)
        assert.is_nil(simMujoco.getInfo('bodies'):find('net\n', 1, true))
    end)
end)

describe('what makes no sense', function()
    before_each(function()
        sim = require 'sim'
        simMujoco = require 'simMujoco'
    end)

    local cases = {
        {'neither a place', function() simMujoco.addFlexcomp(net {element = false}) end, "an injection needs one of 'shapeHandle' and 'element'."},
        {'an unknown element', function() simMujoco.addFlexcomp(net {element = 'arm'}) end, "there is no element 'arm'."},
        {'a shape that is not there', function() simMujoco.addFlexcomp(net {element = false, shapeHandle = 12345}) end, 'object does not exist.'},
        {'no name', function() simMujoco.addFlexcomp(net {name = ''}) end, "a flexcomp needs a 'name'."},
        {'two numbers of nodes', function() simMujoco.addFlexcomp(net {count = {5, 5}}) end, "invalid value of 'count'."},
        {'no nodes', function() simMujoco.addFlexcomp(net {count = {5, 0, 1}}) end, '<flexcomp>: its count is not made of whole numbers from 1 to 10000.'},
        {'a mass that is a text', function() simMujoco.addFlexcomp(net {mass = 'much'}) end, "invalid value of 'mass'."},
        {'a pose without a rotation', function() simMujoco.addFlexcomp(net {pose = {0, 0, 0, 0, 0, 0, 0}}) end, "invalid value of 'pose'."},
        {'a pin too many', function() simMujoco.addFlexcomp(net {pin = {25}}) end, '<flexcomp>: it has no node 25 that could be pinned.'},
        {'another type', function() simMujoco.addFlexcomp(net {type = 'gmsh'}) end, "<flexcomp>: flexcomps of type 'gmsh' are not read."},
        {'XML that is none', function() simMujoco.addInjection {element = 'mujoco', xml = '<option'} end, 'xml: no valid XML'},
        {'no XML', function() simMujoco.addInjection {element = 'mujoco', xml = ''} end, 'xml: there is no element in it.'},
        {'no composite', function() simMujoco.composite('<geom/>', {element = 'worldbody', prefix = 'a'}) end, 'xml: there is not one <composite> in it.'},
        {'a gravity of words', function() simMujoco.addInjection {element = 'mujoco', xml = '<option gravity="down"/>'} end, "<option>: gravity is 'down'."},
        {'a tendon without joints', function() simMujoco.addInjection {element = 'tendon', xml = '<fixed/>'} end, '<fixed>: it has no joints.'},
        {'a motor that moves nothing', function() simMujoco.addInjection {element = 'actuator', xml = '<motor/>'} end, '<motor>: an actuator that moves no joint'},
        {'an exclusion of one', function() simMujoco.addInjection {element = 'contact', xml = '<exclude body1="a"/>'} end, '<exclude>: it has no body1 and body2.'},
        {'a damping of words', function() simMujoco.addInjection {element = 'worldbody', xml = '<joint name="a" damping="much"/>'} end, "<joint>: damping is 'much'."},
        {'no table', function() simMujoco.addFlexcomp(5) end, 'table'},
        {'an unknown question', function() simMujoco.getInfo('all') end, "'what' is neither"},
    }
    for _, case in ipairs(cases) do
        local name, call, message = table.unpack(case)
        it('is an error: ' .. name, function()
            local fine, text = pcall(call)
            assert.is_false(fine)
            assert.is_truthy(tostring(text):find(message, 1, true), text)
        end)
    end

    it('is an error: a name twice', function()
        simMujoco.addFlexcomp(net())
        assert.has_error(function() simMujoco.addFlexcomp(net()) end)
    end)
end)
