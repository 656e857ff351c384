-- What the cases of the third delivery print with.
local sim = require 'sim'
local function str(v)
    if type(v) == 'number' then
        if math.type(v) == 'integer' then return string.format('%d', v) end
        if v ~= v then return 'nan' end
        if math.abs(v) < 5e-10 then v = 0.0 end
        return string.format('%.9f', v)
    elseif type(v) == 'string' then
        return "'" .. v .. "'"
    elseif type(v) == 'table' then
        if isbuffer and isbuffer(v) then return 'buffer[' .. #v .. ']' end
        local t, n = {}, 0
        for _ in pairs(v) do n = n + 1 end
        if #v ~= n then
            local k = {}
            for x in pairs(v) do k[#k + 1] = x end
            table.sort(k, function(a, b) return tostring(a) < tostring(b) end)
            for i, x in ipairs(k) do t[i] = tostring(x) .. '=' .. str(v[x]) end
        else
            for i, x in ipairs(v) do t[i] = str(x) end
        end
        return '{' .. table.concat(t, ', ') .. '}'
    elseif type(v) == 'function' then return 'function'
    end
    return tostring(v)
end
local function P(label, ...) -- print values
    local t = {}
    for i = 1, select('#', ...) do t[i] = str((select(i, ...))) end
    print(label .. ': ' .. table.concat(t, ' '))
end
local quiet = {} -- functions whose results are not printed: whether they return 1 or nothing is another case
for _, n in ipairs {'setObjectAlias', 'setJointInterval', 'setReferencedHandles', 'addReferencedHandle', 'writeTexture', 'setShapeTexture', 'setVisionSensorImg', 'setVisionSensorCharImage', 'setVisionSensorImage', 'ruckigRemove', 'resetProximitySensor', 'scaleObject',
    'scaleObjects', 'setShapeBB', 'relocateShapeFrame', 'alignShapeBB', 'setObjectStringParam', 'setObjectFloatParam', 'setObjectInt32Param', 'writeCustomStringData', 'setObjectParent', 'setObjectChildPose', 'setJointMode', 'setShapeColor', 'breakForceSensor', 'closeScene'} do if sim[n] then quiet[sim[n]] = true end end
local function R(label, f, ...) -- print what f(...) returns, or that it fails
    local r = table.pack(pcall(f, ...))
    if not r[1] then return print(label .. ': error') end
    if quiet[f] then return print(label .. ': done') end
    P(label, table.unpack(r, 2, r.n))
end
local function E(label, f, ...) -- print the tail of the error of f(...)
    local ok, e = pcall(f, ...)
    e = tostring(e):gsub('\n.*', '')
    e = e:match("in sim[%w_%-]*%.[%w_]+: (.*)$") or e:match("in '[^']*': (.*)$") or e:match(':%-?%d+: (.*)$') or e:match('^%-?%d+: (.*)$') or e
    print(label .. ': ' .. (ok and 'no error' or 'error, ' .. e))
end
local function N(h) -- the path of an object in place of its handle
    if type(h) == 'table' then local t = {} for i, x in ipairs(h) do t[i] = N(x) end return t end
    if h == -1 then return '-' end
    local ok, a = pcall(sim.getObjectAlias, h, 2)
    return ok and a or '?'
end

return {str = str, P = P, R = R, E = E, N = N}
