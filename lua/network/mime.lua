--[[
Encodings of mail, with the interface of LuaSocket's module.

    encode('base64'), encode('quoted-printable', mode), decode(...)         filters of ltn12
    wrap('text', length), wrap('quoted-printable', length), normalize(marker), stuff()
    b64, unb64, qp, unqp, wrp, qpwrp, eol, dot                              the functions below these filters

The low-level functions take what the last call left over and a chunk, and return text and what is left over now.
]]

local ltn12 = require('ltn12')
local mime = require('mime.core')
local cycle = ltn12.filter.cycle

mime.encodet, mime.decodet, mime.wrapt = {}, {}, {}

-- A function that picks a maker of filters by name.
local function choose(makers)
    return function(name, first, second)
        if type(name) ~= 'string' then name, first, second = 'default', name, first end
        local make = makers[name]
        if not make then error(('unknown key (%s)'):format(name), 3) end
        return make(first, second)
    end
end

function mime.encodet.base64() return cycle(mime.b64, '') end
mime.encodet['quoted-printable'] = function(mode) return cycle(mime.qp, '', mode == 'binary' and '=0D=0A' or '\r\n') end
function mime.decodet.base64() return cycle(mime.unb64, '') end
mime.decodet['quoted-printable'] = function() return cycle(mime.unqp, '') end

function mime.wrapt.text(length)
    length = length or 76
    return cycle(mime.wrp, length, length)
end
mime.wrapt.base64, mime.wrapt.default = mime.wrapt.text, mime.wrapt.text
mime.wrapt['quoted-printable'] = function(length)
    length = length or 76
    return cycle(mime.qpwrp, length, length)
end

mime.encode, mime.decode, mime.wrap = choose(mime.encodet), choose(mime.decodet), choose(mime.wrapt)

-- @api func filter = mime.normalize(string marker = '\r\n')
function mime.normalize(marker) return cycle(mime.eol, 0, marker) end

-- @api func filter = mime.stuff()
function mime.stuff() return cycle(mime.dot, 2) end

return mime
