--[[
Shapes of letters.

The letters are strokes of our own, since CoppeliaSim's alphabet is a model that comes with it. They lie in the xy plane, are read along x, and
are a tenth of their height thick. Small letters are small capitals; characters beyond ASCII are boxes.
]]

local textUtils = {}

-- Lines through points: column 0 to 4 from the left, row 0 to 6 from the base line.
local STROKES = {
    A = '002640 1232', B = '00063645443303 3342413000', C = '4536160501103041', D = '00062644422000', E = '46060040 0333', F = '460600 0333',
    G = '45361605011030414323', H = '0006 4046 0343', I = '2026 1030 1636', J = '4641301001', K = '0006 460340', L = '060040',
    M = '0006234640', N = '00064046', O = '100105163645413010', P = '00063645443303', Q = '100105163645413010 2240', R = '00063645443303 2340',
    S = '453616050413334241301001', T = '2026 0646', U = '060110304146', V = '062046', W = '0610243046', X = '0046 0640', Y = '062346 2320',
    Z = '06460040',
    ['0'] = '100105163645413010 1135', ['1'] = '152620 1030', ['2'] = '05163645440040', ['3'] = '05163645443313 334241301001',
    ['4'] = '30360242', ['5'] = '460603334241301001', ['6'] = '453616050110304142331302', ['7'] = '064610',
    ['8'] = '13040516364544331302011030414233', ['9'] = '0110304145361605041333 44',
    ['.'] = '2020', [','] = '2110', [':'] = '2121 2424', [';'] = '2424 2110', ['!'] = '2622 2020', ['?'] = '05163645442322 2020',
    ['-'] = '1333', ['+'] = '0343 2125', ['='] = '0242 0444', ['_'] = '0040', ['/'] = '0046', ['\\'] = '0640', ['|'] = '2026',
    ['('] = '36242230', [')'] = '16242210', ['['] = '36161030', [']'] = '16363010', ['{'] = '36252413222130', ['}'] = '16252433222110',
    ['<'] = '450341', ['>'] = '054301', ['*'] = '0343 1135 1531', ['#'] = '1016 3036 0242 0444', ["'"] = '2624', ['"'] = '1614 3634',
    ['`'] = '1625', ['^'] = '142634', ['~'] = '03143243', ['%'] = '0046 1515 3131', ['$'] = '453616050413334241301001 2026',
    ['&'] = '401415263534010110203042', ['@'] = '4010010516364542312224 34',
}
local UNKNOWN <const> = '0006464000'

local ROWS <const>, COLUMNS <const>, GAP <const>, LINE <const> = 6, 4, 2, 9
local SMALL <const> = 0.7
local STROKE <const> = 0.1 -- of the height

local SIDES = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5, 1, 6, 2, 1, 5, 6, 2, 7, 3, 2, 6, 7, 3, 4, 0, 3, 7, 4}

-- Adds a bar from a to b, half as wide as it is thick on each side, to a mesh.
local function addBar(mesh, ax, ay, bx, by, width)
    local dx, dy = bx - ax, by - ay
    local length, half = (dx * dx + dy * dy) ^ 0.5, width / 2
    local ux, uy = half, 0.0
    if length > 0 then ux, uy = dx / length * half, dy / length * half end
    local first = #mesh.vertices // 3
    for _, z in ipairs{0.0, width} do
        for _, corner in ipairs{{ax - ux + uy, ay - uy - ux}, {ax - ux - uy, ay - uy + ux}, {bx + ux - uy, by + uy + ux}, {bx + ux + uy, by + uy - ux}} do
            table.move({corner[1], corner[2], z}, 1, 3, #mesh.vertices + 1, mesh.vertices)
        end
    end
    for _, index in ipairs(SIDES) do mesh.indices[#mesh.indices + 1] = first + index end
end

-- Adds a letter whose lower left corner is at x, y.
local function addLetter(mesh, letter, x, y, unit, width)
    local capital = letter:upper()
    if capital ~= letter then unit = unit * SMALL end
    for line in (STROKES[capital] or UNKNOWN):gmatch('%S+') do
        local ax, ay
        for column, row in line:gmatch('(%d)(%d)') do
            local bx, by = x + column * unit, y + row * unit
            if ax then addBar(mesh, ax, ay, bx, by, width) end
            ax, ay = bx, by
        end
    end
end

-- How far the next letter is, in units of a letter's grid.
local function advance(letter) return (letter:upper() == letter and COLUMNS or COLUMNS * SMALL) + GAP end

local function widthOf(line)
    local width = 0
    for letter in line:gmatch(utf8.charpattern) do width = width + advance(letter) end
    return math.max(0, width - GAP)
end

local function meshOf(text, height, isCentered)
    local mesh, unit, y = {vertices = {}, indices = {}}, height / ROWS, 0.0
    for line in (text .. '\n'):gmatch('(.-)\n') do
        local x = isCentered and -widthOf(line) / 2 or 0.0
        for letter in line:gmatch(utf8.charpattern) do
            if letter ~= ' ' then addLetter(mesh, letter, x * unit, y, unit, height * STROKE) end
            x = x + advance(letter)
        end
        y = y - LINE * unit
    end
    return mesh
end

--- Makes a shape of a text.
-- @param height of a capital letter
-- @param centered the middle of each line is at x = 0, not its start
-- @param alphabetModel has no effect: the letters are our own
-- @param parentDummy the model to add the shape to; else a new dummy
-- @param shapeOnly the result is the shape, without a model
-- @return handle of the model, or of the shape
-- @api int handle = textUtils.generateTextShape(string txt, float[3] color = {1, 1, 1}, float height = 0.1, bool centered = false, any alphabetModel = nil, int parentDummy = nil, bool shapeOnly = false)
function textUtils.generateTextShape(txt, color, height, centered, _, parentDummy, shapeOnly)
    local sim = _quietRequire 'sim'
    local mesh = meshOf(tostring(txt), height or 0.1, centered)
    if #mesh.indices == 0 then error('a text with letters is needed.', 2) end
    local shape = sim.createShape(0, 0.0, mesh.vertices, mesh.indices)
    sim.setObjectAlias(shape, 'text')
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, color or {1, 1, 1})
    if shapeOnly then return shape end
    local model = parentDummy
    if not model then
        model = sim.createDummy((height or 0.1) * STROKE)
        sim.setObjectAlias(model, 'textShape')
        sim.setBoolProperty(model, 'modelBase', true)
    end
    sim.setObjectParent(shape, model, false)
    return model
end

return textUtils
