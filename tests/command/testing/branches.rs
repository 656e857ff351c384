//! `t.branch`: a part of a test that is undone.

use super::{run, simulating};

#[test]
fn a_branch_undoes_what_it_did() {
    let scene = "sim = require 'sim'
        function sysCall_init()
            ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1}, 0)
            sim.setObjectAlias(ball, 'ball')
            sim.setObjectPosition(ball, {0, 0, 1})
            sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
            count = 0
        end
        function sysCall_thread()
            while true do
                count = count + math.random()
                sim.step()
            end
        end";
    let suite = simulating(
        "it('is as before', function()
            t.load('scene.lua')
            t.step(3)
            local script = t.script('/Script')
            local ball = t.object('/ball')
            local before, height = t.hash(), sim.getObjectPosition(ball)[3]
            local seen = {}
            local function future(push)
                seen.pushed = push
                sim.setObjectPosition(ball, {push, 0, 1})
                t.step(5)
                print('in the branch', push)
                return sim.getObjectPosition(ball)[1], script:get('count'), nil, t.hash()
            end
            local x, count, nothing, hash = t.branch(future, 2)
            assert.equal(2, x)
            assert.is_nil(nothing)
            assert.is_nil(seen.pushed)
            assert.equal(before, t.hash())
            assert.equal(height, sim.getObjectPosition(ball)[3])
            -- Another one does not know of the first; the same one is the same.
            local other = {t.branch(future, 3)}
            assert.equal(3, other[1])
            assert.equal(count, other[2])
            assert.same({2, count, nil, hash}, {t.branch(future, 2)})
            -- And the test goes on as if nothing had been.
            local own = {future(2)}
            assert.same({2, count, nil, hash}, own)
        end)
        it('branches again', function()
            local dummy = sim.createDummy(0.1)
            local function at(x) sim.setObjectPosition(dummy, {x, 0, 0}) return sim.getObjectPosition(dummy)[1] end
            local outer, inner, after = t.branch(function()
                at(1)
                return sim.getObjectPosition(dummy)[1], t.branch(at, 2), sim.getObjectPosition(dummy)[1]
            end)
            assert.same({1, 2, 1}, {outer, inner, after})
            assert.equal(0, sim.getObjectPosition(dummy)[1])
        end)
        it('passes errors on', function()
            local dummy = sim.createDummy(0.1)
            local function wrong()
                sim.setObjectPosition(dummy, {1, 0, 0})
                error({code = 7})
            end
            local ok, reason = pcall(t.branch, wrong)
            assert.is_false(ok)
            assert.equal(7, reason.code)
            assert.equal(0, sim.getObjectPosition(dummy)[1])
            assert.has_error(function() t.branch(function() assert.equal(1, 2) end) end)
            assert.has_error(function() t.branch(5) end)
        end)
        it('names what it does not undo', function()
            local file = assert(io.open(t.file('scene.lua')))
            local ok, reason = pcall(t.branch, function() end)
            assert.is_false(ok)
            assert.is_truthy(reason:find('scene.lua'), reason)
            file:close()
            assert.equal(1, t.branch(function() return 1 end))
        end)",
    );
    let files = [("branch_test.lua", suite.as_str()), ("scene.lua", scene)];
    let (code, output) = run(&files, &[]);
    assert_eq!(code, 0, "{output}");
}
