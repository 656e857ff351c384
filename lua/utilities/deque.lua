--[[
A list that grows and shrinks at both ends in constant time.

`deque{1, 2}` or `deque()` makes one; `#d`, `d[1]`, `d[#d] = x` and `ipairs(d)` work as with tables.
]]

local deque = {}

-- The elements are at first .. last of the table in a slot that no script uses as a key.
local SLOT = {}

local function push(d, step, x)
    local list = rawget(d, SLOT)
    if x == nil then error('nil cannot be an element', 3) end
    if step > 0 then
        list.last = list.last + 1
        list[list.last] = x
    else
        list.first = list.first - 1
        list[list.first] = x
    end
end

--- Adds an element at the start.
-- @api deque:pushleft(any x)
function deque:pushleft(x) push(self, -1, x) end

--- Adds an element at the end.
-- @api deque:pushright(any x)
function deque:pushright(x) push(self, 1, x) end

--- Adds an element at the end.
-- @api deque:push(any x)
function deque:push(x) push(self, 1, x) end

--- Adds an element at the end.
-- @api deque:append(any x)
function deque:append(x) push(self, 1, x) end

--- Adds an element at the start.
-- @api deque:appendleft(any x)
function deque:appendleft(x) push(self, -1, x) end

--- Removes and returns the first element; an error if there is none.
-- @api any x = deque:popleft()
function deque:popleft()
    local list = rawget(self, SLOT)
    if list.first > list.last then error('deque is empty', 2) end
    local x = list[list.first]
    list[list.first], list.first = nil, list.first + 1
    return x
end

--- Removes and returns the last element; an error if there is none.
-- @api any x = deque:popright()
function deque:popright()
    local list = rawget(self, SLOT)
    if list.first > list.last then error('deque is empty', 2) end
    local x = list[list.last]
    list[list.last], list.last = nil, list.last - 1
    return x
end

--- Removes and returns the last element; an error if there is none.
-- @api any x = deque:pop()
deque.pop = deque.popright

function deque:__len()
    local list = rawget(self, SLOT)
    return list.last - list.first + 1
end

-- Place of element k in the list, if there is one.
local function place(d, k)
    local list = rawget(d, SLOT)
    if math.type(k) == 'integer' and k >= 1 and k <= list.last - list.first + 1 then return list.first + k - 1 end
end

function deque:__index(k)
    if math.type(k) ~= 'integer' then return deque[k] end
    local at = place(self, k)
    return at and rawget(self, SLOT)[at]
end

function deque:__newindex(k, v)
    local at = place(self, k)
    if not at then error('no element ' .. tostring(k), 2) end
    rawget(self, SLOT)[at] = v
end

function deque:__ipairs()
    return function(d, i)
        if i < #d then return i + 1, d[i + 1] end
    end, self, 0
end
deque.__pairs = deque.__ipairs

function deque.__eq(a, b)
    if #a ~= #b then return false end
    for i = 1, #a do
        if a[i] ~= b[i] then return false end
    end
    return true
end

function deque.unittest()
    local d = deque{2, 3}
    d:pushleft(1)
    d:push(4)
    assert(#d == 4 and d[1] == 1 and d[4] == 4 and d:popleft() == 1 and d:pop() == 4 and d == deque{2, 3})
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

setmetatable(deque, {__call = function(_, values)
    local list = table.move(values or {}, 1, #(values or {}), 1, {first = 1, last = 0})
    list.last = #list
    return setmetatable({[SLOT] = list}, deque)
end})

return deque
