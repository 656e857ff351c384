-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1; grid, sim-2 and sim.Object
print(require 'grid', Grid)
local g = Grid({2, 3}, {1, 2, 3, 4, 5, 6})
print(g, g:dims(), g:stride(1), g:stride(2), g:offset{2, 1}, g:get{2, 3}, g:project(1, 2), g:project(2, 3))
print(g:totable(), g:totable{}, Grid:fromtable(g:totable()) == g, Grid:fromtable(g:totable{}) == g, Grid:fromtable{{{1}, {2}}})
print(g + 1, 1 - g, g * g, -g, g == g:copy(), g == Grid{2, 3}, Grid({2}, 5), Grid{0, 2}:project(2, 1))
local cube = Grid{2, 3, 4}
cube:set({2, 3, 4}, 7)
cube:set({1, 2, 3}, 8)
print(cube:stride(1), cube:offset{2, 3, 4}, cube:project(1, 2):get{3, 4}, cube:project(2, 2):get{1, 3}, cube:project(3, 4):get{2, 3})
for _, bad in ipairs{
    function() g:get{3, 1} end, function() Grid({2}, {1}) end, function() return g + Grid{2} end, function() Grid:fromtable{{1}, {2, 3}} end,
    function() Grid:fromtable{1, {2}} end, function() Grid:fromtable{{1}, 2} end, function() Grid{1.5} end, function() g:project(3, 1) end,
    function() Grid(3) end, function() Grid{1 << 20, 1 << 20} end,
} do print((select(2, pcall(bad)):gsub('^.-Grid: ', ''))) end

sim = require 'sim'
local later = require 'sim-2'
print(type(later), later.getObject == sim.getObject, later == sim, require 'sim-2' == later)
local Object = require 'sim.Object'
print(Object, pcall(Object, sim.createDummy(0.1)))
