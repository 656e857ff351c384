-- topic: globals
-- as: sandbox
-- passes: 0
-- spec: scripts 9; arithmetic with texts gives floats, bitwise operators accept them
print('5' + 1, '5' - '2', 3 * '2', '7' // 2, '7' % 4, -'3', '2' ^ 2, '6' / '3', '0x10' + 0, ' 4 ' + 1, '1.5' * 2, math.type(3 // '1'))
print('5' & 3, 1 | '6', '5' ~ '1', 1 << '4', '16' >> 2, ~'0', '0xff' & 15, '3.0' & 1)
local function fault(f) print((select(2, pcall(f)))) end
fault(function() return 'a' + 1 end)
fault(function() return {} * '1' end)
fault(function() return -'x' end)
fault(function() return 'a' & 1 end)
fault(function() return '1' | {} end)
fault(function() return '1.5' & 1 end)
local object = setmetatable({}, {__add = function(a, b) return type(a) .. ' ' .. type(b) end})
print('1' + object, object + '1', 'text' + object)
