--[[
Colours: red, green, blue and alpha from 0 to 1.

`Color{r, g, b, a}` and `Color('#rrggbb')` make one. As CBOR a colour is tag 4294970000 on its four bytes.
]]

local class = require 'middleclass'
local head = require 'org.conman.cbor_c'
local simCBOR = _quietRequire 'simCBOR'

local Color = class 'Color'

local function component(x, name)
    if type(x) ~= 'number' or not (x >= 0 and x <= 1) then error(('invalid %s: a number from 0 to 1 is needed'):format(name), 4) end
    return x
end

local function fromHtml(text)
    local digits = text:match('^#?(%x+)$')
    if digits and (#digits == 3 or #digits == 4) then digits = digits:gsub('%x', '%0%0') end
    if not digits or #digits ~= 6 and #digits ~= 8 then error('not a colour: ' .. text, 4) end
    local rgba = {}
    for pair in digits:gmatch('..') do rgba[#rgba + 1] = tonumber('0x' .. pair) / 255 end
    return rgba
end

function Color:initialize(rgba)
    if type(rgba) == 'string' then rgba = fromHtml(rgba) end
    if type(rgba) ~= 'table' then error('a table of 3 or 4 numbers is needed', 3) end
    if Color:iscolor(rgba) then rgba = rgba:data() end
    local r, g, b, a = table.unpack(rgba, 1, 4)
    self._rgba = {component(r, 'red'), component(g, 'green'), component(b, 'blue'), component(a or 1, 'alpha')}
end

--- The red component, 0 to 1.
-- @api float red = Color:red()
function Color:red() return self._rgba[1] end

--- The green component, 0 to 1.
-- @api float green = Color:green()
function Color:green() return self._rgba[2] end

--- The blue component, 0 to 1.
-- @api float blue = Color:blue()
function Color:blue() return self._rgba[3] end

--- The opacity, 0 to 1.
-- @api float alpha = Color:alpha()
function Color:alpha() return self._rgba[4] end

-- Hue, saturation and value (Smith 1978).
local function toHsv(r, g, b)
    local most, least = math.max(r, g, b), math.min(r, g, b)
    local range = most - least
    local hue = 0.0
    if range > 0 then
        if most == r then
            hue = (g - b) / range % 6
        elseif most == g then
            hue = (b - r) / range + 2
        else
            hue = (r - g) / range + 4
        end
    end
    return hue / 6, most > 0 and range / most or 0.0, most
end

--- The hue as a fraction of the circle.
-- @api float hue = Color:hue()
function Color:hue() return (toHsv(table.unpack(self._rgba, 1, 3))) end

--- The saturation, 0 to 1.
-- @api float saturation = Color:saturation()
function Color:saturation() return (select(2, toHsv(table.unpack(self._rgba, 1, 3)))) end

--- The value of the HSV model, 0 to 1.
-- @api float value = Color:value()
function Color:value() return math.max(table.unpack(self._rgba, 1, 3)) end

-- 255.1 as CoppeliaSim does: 1 becomes 255 also after a way through single precision.
local function byteOf(x) return math.min(255, math.floor(x * 255.1)) end

--- The red component, 0 to 255.
-- @api int red = Color:r8()
function Color:r8() return byteOf(self:red()) end

--- The green component, 0 to 255.
-- @api int green = Color:g8()
function Color:g8() return byteOf(self:green()) end

--- The blue component, 0 to 255.
-- @api int blue = Color:b8()
function Color:b8() return byteOf(self:blue()) end

--- The opacity, 0 to 255.
-- @api int alpha = Color:a8()
function Color:a8() return byteOf(self:alpha()) end

--- One number, 0xRRGGBB.
-- @api int rgb = Color:rgb888()
function Color:rgb888() return self:r8() << 16 | self:g8() << 8 | self:b8() end

--- One number, 0xRRGGBBAA.
-- @api int rgba = Color:rgba8888()
function Color:rgba8888() return self:rgb888() << 8 | self:a8() end

--- Red, green and blue, 0 to 255.
-- @api int[] rgb = Color:rgb888table()
function Color:rgb888table() return {self:r8(), self:g8(), self:b8()} end

--- Red, green, blue and opacity, 0 to 255.
-- @api int[] rgba = Color:rgba8888table()
function Color:rgba8888table() return {self:r8(), self:g8(), self:b8(), self:a8()} end

--- Red, green, blue and opacity, 0 to 1.
-- @api float[] rgba = Color:data()
function Color:data() return table.move(self._rgba, 1, 4, 1, {}) end

--- The complementary colour.
-- @api Color color = Color:inverted()
function Color:inverted() return Color{1 - self:red(), 1 - self:green(), 1 - self:blue(), self:alpha()} end

--- `#rrggbb`, or `#rrggbbaa` with the format 'rgba'.
-- @api string text = Color:html(string format = 'rgb')
function Color:html(format)
    if format == 'rgba' then return ('#%08x'):format(self:rgba8888()) end
    return ('#%06x'):format(self:rgb888())
end

function Color:__copy() return Color(self:data()) end
function Color:__deepcopy() return Color(self:data()) end

function Color:__eq(other)
    for i = 1, 4 do
        if self._rgba[i] ~= other._rgba[i] then return false end
    end
    return true
end

function Color:__tostring() return ('Color{%s}'):format(table.concat(self._rgba, ', ')) end
function Color:__todisplay() return tostring(self) end
function Color:__iscolor() return true end
function Color:__tocolor() return self end

function Color:__tocbor()
    return head.encode(0xC0, simCBOR.Tags.COLOR) .. head.encode(0x40, 4) .. string.char(table.unpack(self:rgba8888table()))
end

--- A colour of its components, 0 to 1.
-- @api Color color = Color:rgb(float r, float g, float b)
function Color.static.rgb(_, r, g, b) return Color{r, g, b} end

--- A colour of its components and its opacity, 0 to 1.
-- @api Color color = Color:rgba(float r, float g, float b, float a)
function Color.static.rgba(_, r, g, b, a) return Color{r, g, b, a} end

--- A colour of hue, saturation and value, 0 to 1.
-- @api Color color = Color:hsv(float h, float s, float v)
function Color.static.hsv(_, h, s, v)
    local function channel(n)
        local k = (n + h * 6) % 6
        return v - v * s * math.max(0, math.min(k, 4 - k, 1))
    end
    return Color{channel(5), channel(3), channel(1)}
end

--- Whether a value is a colour.
-- @api bool result = Color:iscolor(any c)
function Color.static.iscolor(...)
    local c = select(select('#', ...), ...)
    local meta = type(c) == 'table' and getmetatable(c)
    return type(meta) == 'table' and meta.__iscolor ~= nil
end

--- A colour of a table or a text.
-- @api Color color = Color:tocolor(any c)
function Color.static.tocolor(...)
    local c = select(select('#', ...), ...)
    if Color.iscolor(c) then return getmetatable(c).__tocolor(c) end
    return Color(c)
end

function Color.static.unittest()
    local c = Color:hsv(1 / 3, 1, 1)
    assert(c == Color{0, 1, 0} and c:html() == '#00ff00' and Color('#0f0') == c and c:inverted() == Color{1, 0, 1})
    assert(c:hue() == 1 / 3 and c:saturation() == 1 and c:value() == 1 and c:rgba8888() == 0x00ff00ff)
    assert(simCBOR.decode(simCBOR.encode(c)) == c and Color:tocolor{0, 1, 0} == c and not Color:iscolor{})
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return Color
