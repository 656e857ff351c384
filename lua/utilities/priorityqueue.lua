--[[
A queue that returns the element of the lowest priority first; elements of equal priority in the order of insertion.

`priorityqueue()` makes one. priorityqueue:_compare(a, b) says whether priority a goes before b; a queue may have its own.
]]

local priorityqueue = {}
priorityqueue.__index = priorityqueue

function priorityqueue:_compare(a, b) return a < b end

-- Whether entry a comes out before entry b.
local function before(queue, a, b)
    if queue:_compare(a.priority, b.priority) then return true end
    return not queue:_compare(b.priority, a.priority) and a.number < b.number
end

local function rise(queue, i)
    local heap = queue.heap
    while i > 1 and before(queue, heap[i], heap[i // 2]) do
        heap[i], heap[i // 2] = heap[i // 2], heap[i]
        i = i // 2
    end
end

local function sink(queue, i)
    local heap = queue.heap
    while true do
        local first = i
        for child = 2 * i, 2 * i + 1 do
            if heap[child] and before(queue, heap[child], heap[first]) then first = child end
        end
        if first == i then return end
        heap[i], heap[first] = heap[first], heap[i]
        i = first
    end
end

local function remove(queue, i)
    local heap = queue.heap
    local entry, last = heap[i], table.remove(heap)
    if entry ~= last then
        heap[i] = last
        rise(queue, i)
        sink(queue, i)
    end
    return entry
end

--- Adds an element.
-- @api priorityqueue:push(any priority, any value)
function priorityqueue:push(priority, value)
    if priority == nil or priority ~= priority then error('a priority is a value with an order', 2) end
    self.pushed = self.pushed + 1
    self.heap[#self.heap + 1] = {priority = priority, value = value, number = self.pushed}
    rise(self, #self.heap)
end

--- Removes and returns the element of the lowest priority; nil if there is none.
-- @api any value, any priority = priorityqueue:pop()
function priorityqueue:pop()
    if #self.heap == 0 then return nil end
    local entry = remove(self, 1)
    return entry.value, entry.priority
end

--- The element of the lowest priority; nil if there is none.
-- @api any value, any priority = priorityqueue:peek()
function priorityqueue:peek()
    local entry = self.heap[1]
    if entry then return entry.value, entry.priority end
    return nil
end

--- Whether there are no elements.
-- @api bool result = priorityqueue:isempty()
function priorityqueue:isempty() return #self.heap == 0 end

--- The number of elements.
-- @api int result = priorityqueue:size()
function priorityqueue:size() return #self.heap end
priorityqueue.__len = priorityqueue.size

--- Removes an element; true if it was there.
-- @api bool result = priorityqueue:cancel(any value)
function priorityqueue:cancel(value)
    for i, entry in ipairs(self.heap) do
        if entry.value == value then
            remove(self, i)
            return true
        end
    end
    return false
end

function priorityqueue.unittest()
    local q = priorityqueue()
    for _, priority in ipairs{3, 1, 2, 1} do q:push(priority, 'p' .. priority) end
    assert(q:cancel('p2') and not q:cancel('p2') and q:peek() == 'p1' and q:size() == 3)
    assert(q:pop() == 'p1' and q:pop() == 'p1' and q:pop() == 'p3' and q:isempty() and q:pop() == nil)
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return setmetatable(priorityqueue, {__call = function() return setmetatable({heap = {}, pushed = 0}, priorityqueue) end})
