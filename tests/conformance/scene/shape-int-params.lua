-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: shapes 7
-- tol: 1e-9
-- topic: shapes
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
local s=sim.createPrimitiveShape(3,{.1,.1,.1}) sim.setObjectInt32Param(s,sim.shapeintparam_respondable_mask,0x12345) P('mask 16 bit', sim.getObjectInt32Param(s,sim.shapeintparam_respondable_mask))
for _,n in ipairs{'static','respondable','kinematic','culling','wireframe','edge_visibility'} do local id=sim['shapeintparam_'..n] if id then local a=sim.getObjectInt32Param(s,id) sim.setObjectInt32Param(s,id,1-(a or 0)) P(n..' '..id, a, sim.getObjectInt32Param(s,id)) end end
for i,n in ipairs{'init_velocity_x','init_velocity_y','init_velocity_z','init_ang_velocity_x','init_ang_velocity_y','init_ang_velocity_z'} do local id=sim['shapefloatparam_'..n] if id then sim.setObjectFloatParam(s,id,i) P(n..' '..id, sim.getObjectFloatParam(s,id)) end end
