--[[
Where an embedding program has added functions in Rust, their errors become strings in what catches errors. Internal.

`pcall` and `xpcall` do it when the error is raised, so that variables that are closed on the way get the string too.
]]

local text = ...
local pcall_, xpcall_, type = pcall, xpcall, type
local resume, close, select, load_ = coroutine.resume, coroutine.close, select, load

local function sealed(ok, ...)
    if ok then return ok, ... end
    return ok, text((...))
end

local function protected(f, ...) return xpcall_(f, text, ...) end

function pcall(...)
    if select('#', ...) == 0 then return pcall_() end
    return protected(...)
end

function xpcall(f, handler, ...)
    if type(handler) ~= 'function' then return xpcall_(f, handler, ...) end
    return xpcall_(f, function(problem) return handler(text(problem)) end, ...)
end

function coroutine.resume(...) return sealed(resume(...)) end

function coroutine.close(...) return sealed(close(...)) end

local function loaded(chunk, ...)
    if chunk then return chunk end
    return chunk, text((...))
end

function load(...)
    -- Only a function that reads the chunk can raise.
    if type((...)) ~= 'function' then return load_(...) end
    return loaded(load_(...))
end
