--[[
A parallelogram of crank, coupler and rocker that stands on a fixed base and is closed by a pair of dummies.
]]

local bench = require 'lib.bench'

local M = {LENGTH = 0.2, WIDTH = 0.5, MASS = 0.2} -- of crank and rocker, of the coupler, of each
local LENGTH <const>, WIDTH <const> = M.LENGTH, M.WIDTH

local function bar(from, size, at, parent, mode)
    local joint = bench.joint{at = from, parent = parent, mode = mode, force = mode and 100}
    return joint, bench.body{size = size, at = at, mass = M.MASS, parent = joint}
end

local function tie(hinge, parent)
    local dummy = sim.createDummy(0.01)
    sim.setObjectPose(dummy, sim.getObjectPose(hinge))
    sim.setObjectParent(dummy, parent, true)
    sim.setObjectInt32Param(dummy, sim.dummyintparam_dummytype, sim.dummytype_dynloopclosure)
    return dummy
end

--- Joints crank and rocker, bodies left, coupler and right, the two dummies as ties; mode is that of the crank's control.
function M.build(mode)
    local base = bench.body{at = {WIDTH / 2, 0, 1}, fixed = true}
    local it, upright = {}, {0.02, 0.02, LENGTH}
    it.crank, it.left = bar({0, 0, 1}, upright, {0, 0, 1 + LENGTH / 2}, base, mode)
    local _
    _, it.coupler = bar({0, 0, 1 + LENGTH}, {WIDTH, 0.02, 0.02}, {WIDTH / 2, 0, 1 + LENGTH}, it.left)
    it.rocker, it.right = bar({WIDTH, 0, 1}, upright, {WIDTH, 0, 1 + LENGTH / 2}, base)
    local hinge = bench.joint{at = {WIDTH, 0, 1 + LENGTH}, parent = it.coupler}
    it.ties = {tie(hinge, hinge), tie(hinge, it.right)}
    sim.setLinkDummy(it.ties[1], it.ties[2])
    return it
end

return M
