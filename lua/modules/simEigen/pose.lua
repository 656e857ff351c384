--[[
The class Pose of simEigen: a position `t`, a vector, and an orientation `q`, a quaternion.
]]

return function(simEigen)
    local Matrix, Vector, Quaternion = simEigen.Matrix, simEigen.Vector, simEigen.Quaternion
    local Pose = {}
    simEigen.Pose = Pose

    local function isPose(value) return type(value) == 'table' and getmetatable(value) == Pose end

    local function new(t, q) return setmetatable({t = t, q = q}, Pose) end

    ---------------------------------------------------------------- making

    local function create(_, t, q)
        if isPose(t) then return t:copy() end
        if t == nil then return new(Vector(3), Quaternion()) end
        if type(t) == 'table' and #t == 7 then
            return new(Vector{t[1], t[2], t[3]}, Quaternion{t[4], t[5], t[6], t[7]})
        end
        return new(Vector(Vector:tovector(t, 3)), Quaternion(q))
    end

    --- From a matrix of 4 by 4.
    function Pose:fromtransform(m)
        m = Matrix:tomatrix(m)
        if m:rows() ~= 4 or m:cols() ~= 4 then error('simEigen.Pose: a transform is a matrix of 4 by 4', 2) end
        return new(m:block(1, 4, 3, 1), Quaternion:fromrotation(m:block(1, 1, 3, 3)))
    end

    --- A random pose; positions are from 0 to 1, or between minPos and maxPos.
    function Pose:random(minPos, maxPos)
        local t = Vector(3)
        for i = 1, 3 do
            local low, high = minPos and minPos[i] or 0, maxPos and maxPos[i] or 1
            t[i] = low + (high - low) * math.random()
        end
        return new(t, Quaternion:random())
    end

    function Pose:ispose(value)
        if value == nil then value = self end
        return isPose(value)
    end

    --- A pose of any value that is one.
    function Pose:topose(value)
        if value == nil and isPose(self) then return self end
        return isPose(value) and value or Pose(value)
    end

    ---------------------------------------------------------------- other forms

    --- Seven numbers: position, then x, y, z, w.
    function Pose:data() return table.move(self.q:data(), 1, 4, 4, self.t:data()) end

    function Pose:copy() return new(self.t:copy(), self.q:copy()) end
    Pose.__copy, Pose.__deepcopy = Pose.copy, Pose.copy

    function Pose:tovector() return Vector(self:data()) end

    --- A matrix of 4 by 4.
    function Pose:totransform() return Matrix:eye(4):blockassign(self.q:torotation(), 1, 1):blockassign(self.t, 1, 4) end

    ---------------------------------------------------------------- arithmetic

    function Pose:inv()
        local q = self.q:inv()
        return new(-(q * self.t), q)
    end
    Pose.__unm = Pose.inv

    --- With a pose, or with a vector, which is a point in its frame.
    function Pose:mul(other)
        if isPose(other) then return new(self.t + self.q * other.t, self.q * other.q) end
        return self.t + self.q * other
    end
    Pose.__mul = Pose.mul

    --- Between this pose (t = 0) and another (1).
    function Pose:interp(t, p) return new(self.t + (p.t - self.t) * t, self.q:slerp(t, p.q)) end

    ---------------------------------------------------------------- as a Lua value

    function Pose:__len() return 7 end

    function Pose:__index(k)
        if math.type(k) == 'integer' then return self:data()[k] end
        return Pose[k]
    end

    function Pose:__newindex(k, value)
        if math.type(k) ~= 'integer' or k < 1 or k > 7 then error('simEigen.Pose: no element ' .. tostring(k), 2) end
        if k <= 3 then self.t[k] = value else self.q[k - 3] = value end
    end

    function Pose:__pairs()
        return function(p, i)
            if i < 7 then return i + 1, p[i + 1] end
        end, self, 0
    end

    function Pose.__eq(a, b) return isPose(a) and isPose(b) and a.t == b.t and a.q == b.q end

    function Pose:__tostring() return ('Pose({%s})'):format(table.concat(self:data(), ', ')) end

    function Pose:__ispose() return true end

    function Pose:__topose() return self end

    function Pose:__tocbor()
        local cbor, head = require('org.conman.cbor'), require('org.conman.cbor_c')
        return head.encode(0xC0, 4294980500) .. cbor.encode(self:data())
    end

    setmetatable(Pose, {__call = create, __tostring = function() return 'class Pose' end})
end
