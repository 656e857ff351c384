-- topic: simIM
-- as: sandbox
-- passes: 0
-- spec: simim 1, simim 2
sim = require 'sim'
simIM = require 'simIM'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function values(im)
    local size, t = simIM.size(im), {}
    for y = 0, size[2] - 1 do
        for x = 0, size[1] - 1 do t[#t + 1] = table.concat(simIM.get(im, {x, y}), ',') end
    end
    return table.concat(t, ' ')
end
local rgb = simIM.format._8UC3
print(simIM.format._8UC1, simIM.format._32FC4, simIM.interp.nearest, simIM.cmpOp.eq, simIM.reduceOp.sum, simIM.flipOp.x, simIM.dict_type._4X4_50, simIM.dict_type._APRILTAG_36h11)

-- sizes and formats
print(simIM.size(simIM.create(640, 480)), simIM.size(simIM.createFromData(2, 1, 'abcdef')))
print(simIM.getFormat(simIM.create(1, 1)) == rgb, simIM.getFormat(simIM.create(1, 1, simIM.format._32FC1)))
print(simIM.get(simIM.create(1, 1, rgb, 7), {0, 0}))
local im = simIM.createFromData(1, 1, '\255\0\0')
print((im:gsub('^%x+', 'hex')))
print(simIM.get(im, {0, 0}), simIM.get(simIM.rgb2gray(im), {0, 0}))
for _, colour in ipairs {'\0\0\255', '\0\255\0'} do print(simIM.get(simIM.rgb2gray(simIM.createFromData(1, 1, colour)), {0, 0})) end
print(simIM.get(simIM.rgb2hsv(im), {0, 0}), simIM.get(simIM.rgb2hls(im), {0, 0}))
print(simIM.get(simIM.rgb2hsv(simIM.convert(im, simIM.format._32FC3, 1 / 255)), {0, 0}))
print(simIM.get(simIM.hsv2rgb(simIM.rgb2hsv(im)), {0, 0}), simIM.get(simIM.hls2rgb(simIM.rgb2hls(im)), {0, 0}))
print(simIM.get(simIM.gray2rgb(simIM.rgb2gray(im)), {0, 0}))
print(simIM.get(simIM.createFromData(1, 1, 'abcd', simIM.format._8UC4), {0, 0}))
simIM.set(im, {0, 0}, {300, 2.5, -1})
print(simIM.get(im, {0, 0}))

-- arithmetic
local a = simIM.createFromData(1, 1, '\255\0\0')
print(simIM.get(simIM.addK(a, {10, 10, 10}), {0, 0}))
print(simIM.addK(a, {1, 2, 3}, true) == a, simIM.get(a, {0, 0}))
local b = simIM.createFromData(1, 1, '\10\20\30')
for _, f in ipairs {'add', 'subtract', 'absdiff', 'multiply', 'divide', 'bitwiseAnd', 'bitwiseOr', 'bitwiseXor'} do print(f, simIM.get(simIM[f](a, b), {0, 0})) end
for _, f in ipairs {'subtractK', 'absdiffK', 'bitwiseAndK', 'bitwiseOrK', 'bitwiseXorK'} do print(f, simIM.get(simIM[f](b, {15, 15, 15}), {0, 0})) end
print(simIM.get(simIM.divideK({60, 60, 60}, b), {0, 0}), simIM.get(simIM.bitwiseNot(b), {0, 0}), simIM.get(simIM.abs(b), {0, 0}))
print(simIM.get(simIM.compare(a, b, simIM.cmpOp.gt), {0, 0}), simIM.get(simIM.compareK(b, {20, 20, 20}, simIM.cmpOp.le), {0, 0}))
print(simIM.get(simIM.addWeighted(a, b, 0.5, 2, 1), {0, 0}), simIM.get(simIM.scaleAdd(b, b, 3), {0, 0}), simIM.get(simIM.pow(b, 2), {0, 0}))
local x = simIM.convert(simIM.createFromData(1, 1, '\3\4\0'), simIM.format._32FC3)
local y = simIM.convert(simIM.createFromData(1, 1, '\4\3\1'), simIM.format._32FC3)
print(simIM.get(simIM.magnitude(x, y), {0, 0}), simIM.get(simIM.phase(x, y, true), {0, 0}))
local length, angle = simIM.polar2cart(x, y, true)
print(simIM.get(length, {0, 0}), simIM.get(angle, {0, 0}))
print(simIM.get(simIM.sqrt(y), {0, 0}), simIM.get(simIM.exp(simIM.log(y)), {0, 0}))

-- regions and channels
local two = simIM.createFromData(2, 1, '\1\2\3\4\5\6')
print(values(two), values(simIM.flip(two, simIM.flipOp.x)), values(simIM.flip(two)))
print(values(simIM['repeat'](two, 2, 1)), values(simIM.reduce(two, 1, simIM.reduceOp.max)), values(simIM.resize(two, 4, 1, simIM.interp.nearest)))
print(values(simIM.resize(two, 1, 1, simIM.interp.area)), simIM.size(simIM.resize(two, 3, 5)))
local target = simIM.create(2, 2)
simIM.copy(two, {1, 0}, target, {0, 1}, {1, 1})
print(values(target))
local parts = simIM.split(two)
print(#parts, simIM.getFormat(parts[1]), simIM.size(parts[1]), values(simIM.merge {parts[3], parts[2], parts[1]}))
print((select(2, pcall(simIM.mixChannels, {two}, {target}, {0, 0})):find('OpenCV(', 1, true)) ~= nil)
local other = simIM.createFromData(2, 1, '\0\0\0\0\0\0')
simIM.mixChannels({two}, {other}, {0, 2, 2, 0})
e(simIM.mixChannels, {two}, {other}, {0})
print(values(other))
e(simIM.getFormat, simIM.merge {parts[1], parts[2]})
local far = simIM.distanceTransform(simIM.compareK(parts[1], {5}, simIM.cmpOp.gt))
print(simIM.getFormat(far), simIM.get(far, {0, 0}))

-- drawing
local canvas = simIM.create(9, 9)
simIM.line(canvas, {0, 0}, {8, 0}, {255, 0, 0})
print(simIM.get(canvas, {3, 0}), simIM.get(canvas, {3, 1}))
simIM.circle(canvas, {4, 4}, 2, {0, 255, 0}, -1)
print(simIM.get(canvas, {4, 4}), simIM.get(canvas, {4, 6}), simIM.get(canvas, {4, 7}))
simIM.rectangle(canvas, {0, 0}, {8, 8}, {1, 2, 3})
simIM.polylines(canvas, {0, 0, 8, 8, 8, 0}, {3}, true, {9, 9, 9}, 2, 16)
simIM.fillPoly(canvas, {0, 0, 2, 0, 2, 2}, {3}, {1, 1}, {7, 7, 7})
simIM.fillConvexPoly(canvas, {6, 6, 8, 6, 8, 8}, {5, 5, 5})
simIM.ellipse(canvas, {4, 4}, {3, 2}, 30)
simIM.arrowedLine(canvas, {0, 8}, {8, 8}, {1, 1, 1})
simIM.text(canvas, 'x', {0, 8}, simIM.fontFace.plain)
print(simIM.get(canvas, {8, 3}), select('#', simIM.textSize('text')))
print(simIM.clipLine(canvas, {-5, 4}, {20, 4}))
print(simIM.clipLine(canvas, {-5, -4}, {20, -4}))
e(simIM.polylines, canvas, {0, 0, 8}, {2}, true, {9, 9, 9})
e(simIM.polylines, canvas, {0, 0, 8, 8}, {3}, true, {9, 9, 9})
e(simIM.circle, canvas, {4, 4}, -2, {0, 255, 0})
e(simIM.line, canvas, {0, 0}, {1, 1}, {0, 0, 0}, 1 << 40)
simIM.line(canvas, {math.mininteger, 0}, {math.maxinteger, 5}, {0, 0, 0}, 5, 16)

-- errors
e(simIM.getMarkerDictionary, 1)
e(simIM.get, 'x', {0, 0})
e(simIM.create, 0, 1)
e(simIM.create, 1, -1)
e(simIM.create, 1 << 20, 1 << 20)
e(simIM.create, 1, 1, 1)
e(simIM.createFromData, 2, 2, 'abc')
print((select(2, pcall(simIM.createFromData, 1, 1, 'a', simIM.format._8UC1)):find('OpenCV(', 1, true)) ~= nil)
print((select(2, pcall(simIM.add, two, a)):find('OpenCV(', 1, true)) ~= nil)
print((select(2, pcall(simIM.exp, two)):find('OpenCV(', 1, true)) ~= nil)
print((select(2, pcall(simIM.copy, two, {2, 0}, two, {0, 0}, {1, 1})):find('OpenCV(', 1, true)) ~= nil)
e(simIM.split, parts[1])
e(simIM.merge, {parts[1]})
e(simIM.merge, {parts[1], 'x'})
e(simIM.set, two, {0, 0}, {1})
e(simIM.get, two, {2, 0})
e(simIM.openVideoCapture, 0)
e(simIM.readFromVideoCapture, 0)
e(simIM.closeVideoCapture, 0)
e(simIM.destroy, two)
e(simIM.destroy, two)
e(simIM.size, two)
