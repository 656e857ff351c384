--[[
Less common ways to load code: import, rerequire, require in a thread, and require with the handle of a script object.

Does not search for files: that stays with package.searchers.
]]

local M = {}

local function loaderOf(name)
    for _, search in ipairs(package.searchers) do
        local loader, place = search(name)
        if type(loader) == 'function' then return loader, place end
    end
end

local function message(text) return text end

--- Loads a module that may call sim.step while it is loaded; it is not pre-empted. nil if no module has this name.
function M.inThread(name)
    local loader, place = loaderOf(name)
    if not loader then return nil end
    setAutoYield(false)
    local ok, module = xpcall(loader, message, name, place)
    setAutoYield(true)
    if not ok then error(module, 0) end
    local loaded = package.loaded
    if module ~= nil then loaded[name] = module end
    if loaded[name] == nil then loaded[name] = true end
    return loaded[name]
end

--- Runs the text of a script object as a chunk and returns its results; nothing is cached.
function M.fromScript(handle)
    local sim = package.loaded.sim
    local code = sim.getStringProperty(handle, 'code', {noError = true})
    if not code then error("module '" .. handle .. "' not found: no script object has this handle", 0) end
    local chunk, message = load(code, sim.getObjectAlias(handle, 5))
    if not chunk then error(message, 0) end
    setYieldAllowed(false)
    local results = table.pack(xpcall(chunk, function(text) return text end, handle))
    setYieldAllowed(true)
    if not results[1] then error(results[2], 0) end
    return table.unpack(results, 2, results.n)
end

--- Loads a module again even if it was loaded before.
function M.rerequire(name)
    package.loaded[name] = nil
    return require(name)
end

local function namesToImport(module, first, ...)
    if first ~= '*' then return {first, ...} end
    local names = {}
    if type(module) == 'table' then
        for name in pairs(module) do names[#names + 1] = name end
    end
    return names
end

local function importNames(module, moduleName, ...)
    for _, name in ipairs(namesToImport(module, ...)) do
        local member = type(module) == 'table' and module[name]
        if member == nil or type(module) ~= 'table' then error(("no '%s' in module '%s'"):format(name, moduleName), 3) end
        _G[name] = member
    end
end

--- Loads a module and makes it, or some of its functions, global.
-- import(name) sets a global of the module's name; import(name, 'f', 'g') sets f and g; import(name, '*') and import('name.*') set all;
-- import(name, {as = 'short'}) sets a global of another name.
function M.import(moduleName, first, ...)
    local all = first == nil and moduleName:match('^(.*)%.%*$')
    if all then moduleName, first = all, '*' end
    local module = require(moduleName)
    if first == nil or type(first) == 'table' then
        print('#names == 0') -- the original writes this line; logs are compared
        _G[first and first.as or moduleName:match('[^.]*$')] = module
    else
        importNames(module, moduleName, first, ...)
    end
    return module
end

return M
