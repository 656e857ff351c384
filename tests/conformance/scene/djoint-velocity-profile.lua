-- as: simulation
-- passes: 34
-- engine: bullet278
-- spec: joints 7
-- tol: 0.026
-- agrees: bullet278 bullet283 ode newton mujoco
-- topic: dynjoints
sim = require 'sim'
local function str(v)
    if type(v) == 'number' then
        if math.type(v) == 'integer' then return string.format('%d', v) end
        if v ~= v then return 'nan' end
        if math.abs(v) < 5e-10 then v = 0.0 end
        return string.format('%.9f', v)
    elseif type(v) == 'table' then
        local t = {}
        if #v == 0 and next(v) ~= nil then
            local k = {}
            for x in pairs(v) do k[#k + 1] = tostring(x) end
            table.sort(k)
            for i, x in ipairs(k) do t[i] = x .. '=' .. str(v[x]) end
        else
            for i, x in ipairs(v) do t[i] = str(x) end
        end
        return '{' .. table.concat(t, ', ') .. '}'
    end
    return tostring(v)
end
local function P(label, ...) -- print values
    local t = {}
    for i = 1, select('#', ...) do t[i] = str((select(i, ...))) end
    print(label .. ': ' .. table.concat(t, ' '))
end
local function Q(label, t) -- print a quaternion or pose, sign of the quaternion normalised
    local o, s, r = #t - 4, 0, {}
    for _, i in ipairs {4, 1, 2, 3} do if s == 0 and math.abs(t[o + i]) > 1e-9 then s = t[o + i] end end
    for i = 1, #t do r[i] = (i > o and s < 0) and -t[i] or t[i] end
    P(label, r)
end
local function X(label, f, ...) -- print the tail of the error raised by f(...)
    local ok, e = pcall(f, ...)
    e = tostring(e):gsub('\nstack traceback.*', '')
    e = e:match("in sim[%w_%-]*%.[%w_]+: (.*)$") or e:match("in '[^']*': (.*)$") or e:match(':%d+: (.*)$') or e
    print(label .. ': ' .. (ok and 'no error' or 'error, ' .. e))
end
local function box(x, y, z, sx, sy, sz, mass, dyn, type_) -- respondable shape, dynamic if dyn
    local h = sim.createPrimitiveShape(type_ or sim.primitiveshape_cuboid, {sx, sy, sz}, 0)
    sim.setObjectPosition(h, {x, y, z})
    sim.setShapeMass(h, mass)
    sim.setObjectInt32Param(h, sim.shapeintparam_static, dyn and 0 or 1)
    sim.setObjectInt32Param(h, sim.shapeintparam_respondable, 1)
    return h
end
local function ghost(...) -- same, not respondable
    local h = box(...)
    sim.setObjectInt32Param(h, sim.shapeintparam_respondable, 0)
    return h
end
local function arm(inertia, g) -- static base A, joint J (z along world +y) at (0,0,1), 1 kg body B with COM 0.1 m along +x when g is given, on the axis otherwise;
    -- inertia: about the joint axis. Gravity g along -z (default 0)
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, -(g or 0)})
    A = ghost(0, 0, 1, 0.1, 0.1, 0.1, 1, false)
    J = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPose(J, sim.buildPose({0, 0, 1}, {-math.pi / 2, 0, 0}))
    sim.setObjectParent(J, A, true)
    local x, i = 0, inertia
    if g then x, i = 0.1, inertia - 0.01 end
    B = ghost(x, 0, 1, 0.1, 0.1, 0.1, 1, true)
    sim.setShapeInertia(B, {i, 0, 0, 0, i, 0, 0, 0, i}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})
    sim.setObjectParent(B, J, true)
end
function sysCall_init() n=0 arm(0.01) sim.setObjectInt32Param(J,2039,sim.jointdynctrl_velocity) sim.setObjectInt32Param(J,2040,1) sim.setJointTargetForce(J,1000) sim.setJointTargetVelocity(J,1,{2,20}) end
function sysCall_sensing() n=n+1 if n==4 or n==8 or n==12 or n==30 then P('pass '..n, sim.getJointVelocity(J)) end end
