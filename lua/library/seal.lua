--[[
Where an embedding program has added functions in Rust, their errors become strings in what catches errors. Internal.
]]

local text = ...
local pcall_, xpcall_, type = pcall, xpcall, type
local resume, close = coroutine.resume, coroutine.close

local function sealed(ok, ...)
    if ok then return ok, ... end
    return ok, text((...))
end

function pcall(...) return sealed(pcall_(...)) end

function xpcall(f, handler, ...)
    if type(handler) ~= 'function' then return xpcall_(f, handler, ...) end
    return xpcall_(f, function(problem) return handler(text(problem)) end, ...)
end

function coroutine.resume(...) return sealed(resume(...)) end

function coroutine.close(...) return sealed(close(...)) end
