--[[
Results of the standard simulation interfaces of ROS 2. Internal.
]]

local M = {
    FEATURE_UNSUPPORTED = 0,
    NOT_FOUND = 2,
    INCORRECT_STATE = 3,
    OPERATION_FAILED = 4,
    OK = {result = 1},
}

--- A response that all is well, with further fields.
function M.ok(fields)
    local response = fields or {}
    response.result = M.OK
    return response
end

--- A response that says why something did not work.
function M.failed(code, message) return {result = {result = code, error_message = message}} end

function M.notFound(what, name) return M.failed(M.NOT_FOUND, ("there is no %s '%s'"):format(what, name)) end

--- What an error says, without the place in the library and its traceback.
function M.reason(failure)
    local line = tostring(failure):match('^[^\n]*')
    return (line:gsub('^%b[]:%d+: ', ''))
end

--- Whether tags pass a filter of tags: any of them, or all.
function M.passTags(tags, filter)
    if #filter.tags == 0 then return true end
    local has, count = {}, 0
    for _, tag in ipairs(tags) do has[tag] = true end
    for _, tag in ipairs(filter.tags) do count = count + (has[tag] and 1 or 0) end
    if filter.filter_mode == 1 then return count == #filter.tags end
    return count > 0
end

return M
