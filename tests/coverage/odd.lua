-- All that makes jumps, over several lines where possible.
local function many(flag)
    local t = {}
    -- MANY
    if flag then
        t.never = 1
    end
    for i = 1, 3 do
        t[#t + 1] = i
        if i == 5 then t.no = 1
        else t.yes = 1 end
    end
    return t
end

local function conditions(a, b, c)
    local x = a
        and b
        or c
    if a
        and b then
        x = 1
    elseif b or
        c
    then
        x = 2
    else
        x = 3
    end
    if not a then x = 4 end if b then
        x = 5 end
    local y = a == nil
        and 1 or
        2
    return x, y,
        a < 3
        and 'less'
        or 'more'
end

local function loops(n)
    local sum = 0
    for i = 1,
        n do
        if i % 2 == 0 then goto continue end
        sum = sum + i
        ::continue::
    end
    for i = n, 1 do
        sum = sum - 1
    end
    for _, v in ipairs { 1, 2 } do sum = sum + v end
    for _, v in
        ipairs { 1, 2 }
    do
        sum = sum + v
        if v == 2 then break end
    end
    for k in pairs({}) do
        sum = k
    end
    while true do
        sum = sum + 1
        if sum > 30 then
            break
        end
    end
    while sum > 20 do sum = sum - 1 end
    repeat local done = sum < 10
        sum = sum - 1
    until done
    repeat
        sum = sum + 1 until sum > 0
    return sum
end

local function calls(...)
    local a, b = ...
    local t = {
        a,
        [b] = 1,
        x = function() return
            2 end,
        f = math.max(
            1,
            2,
            select('#', ...)
        ),
        ...
    }
    return t, math.min(
        1,
        (...)
    ), (select(2,
        ...))
end

local function closes()
    local x <close> = setmetatable({}, { __close = function()
        closed = true
    end })
    do
        local y <close> = nil
        local z <const> = 3
        closed = z
    end
    local f = function(...)
        return ...
    end
    return f(
        f(1),
        f(2)
    )
end

local function fails()
    local ok = pcall(function()
        local nothing
        local before = 1
        local wrong = nothing.x
        local after = 2
    end)
    local co = coroutine.wrap(function(x)
        while x do
            x = coroutine.yield(x)
        end
        return 'end'
    end)
    co(1) co(2)
    return ok, 1 < 2, not ok, -1 // 2, 3 & 1, 'a'
        .. 'b' ..
        tostring(ok)
end

local object = { value = 1 }
function object:method(
    x,
    y
)
    self.value = x + y
    return self
end

many(false)
conditions(1, false, 2) conditions(1, 2)
loops(7)
calls(1, 2, 3)
closes()
fails()
object:method(1, 2):method(
    3, 4
):method(5, 6)
if object then else
    many(true)
end
return many, conditions
