--[[
Callbacks of the solver: they see matrices and may answer with matrices, flat lists or lists of rows.
]]

local callbacks = {}

local FIELDS <const> = {'jacobian', 'e', 'dq', 'jacobianPinv'}

local function flat(value)
    if type(value) ~= 'table' then return value end
    if type(value.data) == 'function' then return value:data() end
    if type(value[1]) ~= 'table' then return value end
    local list = {}
    for _, row in ipairs(value) do table.move(row, 1, #row, #list + 1, list) end
    return list
end

--- The function that the native solver calls.
function callbacks.of(callback, aux)
    local Matrix = require('matrix-2').Matrix
    local call = type(callback) == 'string' and _G[callback] or callback
    return function(data)
        data.jacobian = Matrix(#data.rows, #data.cols, data.jacobian)
        data.e = Matrix(#data.rows, 1, data.e)
        local answer = call(data, aux)
        if type(answer) ~= 'table' then return {} end
        local revision = {}
        for _, field in ipairs(FIELDS) do revision[field] = flat(answer[field]) end
        return revision
    end
end

return callbacks
