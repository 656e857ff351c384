--[[
The class Quaternion of simEigen: x, y, z, w. An object holds the handle of a native quaternion, which ends with it.
]]

return function(simEigen)
    local Matrix, Vector = simEigen.Matrix, simEigen.Vector
    local Quaternion = {}
    simEigen.Quaternion = Quaternion

    local PLACES <const> = {x = 1, y = 2, z = 3, w = 4}

    local function isQuaternion(value) return type(value) == 'table' and getmetatable(value) == Quaternion end

    local function wrap(handle) return setmetatable({__handle = handle}, Quaternion) end

    local function vector(handle) return setmetatable({__handle = handle}, Matrix) end

    ---------------------------------------------------------------- making

    local function create(_, data)
        if isQuaternion(data) then return data:copy() end
        if data == nil or #data == 0 then return wrap(simEigen.quatNew()) end
        if #data ~= 4 then error('simEigen.Quaternion: 4 numbers are needed', 2) end
        return wrap(simEigen.quatNew{data[1], data[2], data[3], data[4]})
    end

    function Quaternion:fromaxisangle(axis, angle)
        return wrap(simEigen.quatFromAxisAngle(Vector:tovector(axis, 3).__handle, angle))
    end

    --- From Euler angles as those of `sim`.
    function Quaternion:fromeuler(euler) return wrap(simEigen.quatFromEuler(Vector:tovector(euler, 3).__handle)) end

    --- From yaw, pitch and roll.
    function Quaternion:fromypr(ypr) return wrap(simEigen.quatFromYPR(Vector:tovector(ypr, 3).__handle)) end

    function Quaternion:fromrotation(rotation) return wrap(simEigen.quatFromRotation(Matrix:tomatrix(rotation).__handle)) end

    --- The shortest rotation of one direction to another.
    function Quaternion:fromtwovectors(v1, v2)
        return wrap(simEigen.quatFromTwoVectors(Vector:tovector(v1, 3).__handle, Vector:tovector(v2, 3).__handle))
    end

    function Quaternion:random() return wrap(simEigen.quatRandom()) end

    function Quaternion:isquaternion(value)
        if value == nil then value = self end
        return isQuaternion(value)
    end

    --- A quaternion of any value that is one.
    function Quaternion:toquaternion(value)
        if value == nil and isQuaternion(self) then return self end
        return isQuaternion(value) and value or Quaternion(value)
    end

    function Quaternion:freeze() error('simEigen.Quaternion: freeze is not implemented in Swanilda: what it does is not known', 2) end

    ---------------------------------------------------------------- other forms

    function Quaternion:data() return simEigen.quatGetData(self.__handle) end

    function Quaternion:copy() return wrap(simEigen.quatCopy(self.__handle)) end
    Quaternion.__copy, Quaternion.__deepcopy = Quaternion.copy, Quaternion.copy

    function Quaternion:toaxisangle()
        local axis, angle = simEigen.quatToAxisAngle(self.__handle)
        return vector(axis), angle
    end

    --- Axis and angle of the rotation, or of that from here to another quaternion.
    function Quaternion:axisangle(q2) return (q2 and self:inv() * q2 or self):toaxisangle() end

    function Quaternion:toeuler() return vector(simEigen.quatToEuler(self.__handle)) end

    function Quaternion:toypr() return vector(simEigen.quatToYPR(self.__handle)) end

    --- A matrix of 3 by 3.
    function Quaternion:torotation() return vector(simEigen.quatToRotation(self.__handle)) end

    function Quaternion:tovector() return Vector(self:data()) end

    ---------------------------------------------------------------- arithmetic

    function Quaternion:inv() return wrap(simEigen.quatInv(self.__handle)) end

    --- With a quaternion, or with a vector, which is rotated.
    function Quaternion:mul(other)
        if isQuaternion(other) then return wrap(simEigen.quatMulQuat(self.__handle, other.__handle, false)) end
        return vector(simEigen.quatMulVec(self.__handle, Vector:tovector(other, 3).__handle))
    end
    Quaternion.__mul = Quaternion.mul

    function Quaternion:imul(other)
        simEigen.quatMulQuat(self.__handle, other.__handle, true)
        return self
    end

    --- Between this one (t = 0) and another (1).
    function Quaternion:slerp(t, q2) return wrap(simEigen.quatSLERP(self.__handle, q2.__handle, t)) end

    function Quaternion:__unm() error('simEigen.Quaternion: the operator - is not implemented in Swanilda: what it does is not known', 2) end

    ---------------------------------------------------------------- as a Lua value

    function Quaternion:__len() return 4 end

    function Quaternion:__index(k)
        local place = PLACES[k] or math.type(k) == 'integer' and k
        if not place then return Quaternion[k] end
        return self:data()[place]
    end

    function Quaternion:__newindex(k, value)
        local place = PLACES[k] or math.type(k) == 'integer' and k >= 1 and k <= 4 and k
        if not place then error('simEigen.Quaternion: no element ' .. tostring(k), 2) end
        local data = self:data()
        data[place] = value
        simEigen.quatSetData(self.__handle, data)
    end

    function Quaternion:__pairs()
        return function(q, i)
            if i < 4 then return i + 1, q[i + 1] end
        end, self, 0
    end

    function Quaternion.__eq(a, b)
        if not (isQuaternion(a) and isQuaternion(b)) then return false end
        local other = b:data()
        for i, x in ipairs(a:data()) do
            if x ~= other[i] then return false end
        end
        return true
    end

    function Quaternion:__tostring() return ('Quaternion({%s})'):format(table.concat(self:data(), ', ')) end

    function Quaternion:__gc() pcall(simEigen.quatDestroy, rawget(self, '__handle')) end

    function Quaternion:__isquaternion() return true end

    function Quaternion:__toquaternion() return self end

    function Quaternion:__tocbor()
        local cbor, head = require('org.conman.cbor'), require('org.conman.cbor_c')
        return head.encode(0xC0, 4294980000) .. cbor.encode(self:data())
    end

    setmetatable(Quaternion, {__call = create, __tostring = function() return 'class Quaternion' end})
end
