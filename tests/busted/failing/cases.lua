--[[
Reads and writes the files of this folder: assertions that do not hold, each with its message.

A case is one or more lines that begin with '>>> ', the code, and below them the message it ends with.
]]

local cases = {}

local CODE <const> = '^>>> ?(.*)$'

--- Addresses differ between runs; and the original blames itself for bad arguments, where Swanilda names the caller.
local function normalized(message)
    message = message:gsub('0x%x+', '0x'):gsub('^[^\n]-luassert[%w/_]*%.lua:%d+: ', 'case:1: ')
    return (message:gsub('%s+$', ''))
end

--- The cases of a text: code and message.
function cases.parse(text)
    local list = {}
    local inCode = false
    for line in (text .. '\n'):gmatch('(.-)\n') do
        local code = line:match(CODE)
        if code and inCode then
            list[#list].code = list[#list].code .. '\n' .. code
        elseif code then
            list[#list + 1] = {code = code, message = ''}
        elseif #list > 0 then
            list[#list].message = list[#list].message .. line .. '\n'
        end
        inCode = code ~= nil
    end
    for _, case in ipairs(list) do case.message = case.message:gsub('%s+$', '') end
    return list
end

--- What the code of a case raises, as text.
function cases.run(code, names)
    local chunk = assert(load(code, '=case', 't', setmetatable(names, {__index = _G})))
    local snapshot = names.assert:snapshot()
    local passed, message = pcall(chunk)
    snapshot:revert()
    return passed and '(no failure)' or normalized(tostring(message))
end

--- The text of cases.
function cases.format(list)
    local parts = {}
    for _, case in ipairs(list) do
        parts[#parts + 1] = ('>>> %s\n%s\n'):format(case.code:gsub('\n', '\n>>> '), case.message)
    end
    return table.concat(parts, '\n')
end

return cases
