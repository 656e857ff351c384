-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1; every function the reference names is there, and the modules' own tests
local wanted = {
    ['stringx.functions'] = [[qsplit gsplit split startswith endswith trim ltrim rtrim chars bytes escpat isalnum isalpha isidentifier islower isnumeric
        isprintable isspace isupper capitalize escapequotes escapehtml stripmarkdown renderxml stripprefix stripsuffix elide utf8sub _len pad
        blocksize blockpad blockhstack unittest]],
    ['tablex.functions'] = [[unpackx index eq keys filter invert isarray join tostring slice print find compare reversed sorted clone deepcopy add extend rep
        batched flatten collapse unflatten update items frompairs fromipairs getn setn unittest]],
    ['mathx.functions'] = [[random2 randomseed2 median atan2 cosh frexp hypot ldexp log10 mod pow sign sinh tanh]],
    ['functional.functions'] = [[range map reduce filter foreach identity zip negate apply partial any all iter reify sum prod operator unittest]],
    ['var.functions'] = 'getvar setvar getlocals f unittest', copy = 'copy deepcopy unittest',
    ['checkargs.check'] = 'checkarg getdefault checkargsEx checkargs unittest',
    deque = 'pushleft pushright push append appendleft popleft popright pop unittest',
    priorityqueue = 'push pop peek isempty size cancel _compare unittest',
    itertools = 'chain ichain product permutations combinations combinations_with_replacement',
    lfsx = [[attributes chdir currentdir dir lock link mkdir rmdir setmode symlinkattributes touch unlock rmdir_r pathsanitize pathsep pathsplit
        pathjoin pathparts basename dirname isfile isdir ispathabsolute makedirs gettempdir realpath unittest]],
    dkjson = 'encode decode null quotestring use_lpeg version encodeexception', json = 'encode decode',
    cbor = 'encode decode decode_file', simCBOR = 'encode decode pdecode pencode isnumber isinteger isfloat TYPE TAG SIMPLE __ENCODE_MAP _VERSION null Tags',
    ['org.conman.cbor'] = 'encode decode pdecode pencode isnumber isinteger isfloat TYPE TAG SIMPLE __ENCODE_MAP _VERSION',
    Buffer = 'initialize isbuffer tobuffer', Color = 'initialize red green blue alpha hue saturation value data inverted html rgb rgba hsv iscolor tocolor unittest',
}
local names = {}
for name in pairs(wanted) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do
    local module = require(name)
    for member in wanted[name]:gmatch('%S+') do
        if module[member] == nil then print('missing', name, member) end
    end
    if wanted[name]:find('unittest') then module.unittest() end
end
local copy = require 'copy'
local object = setmetatable({}, {__copy = function() return 'a copy' end, __deepcopy = function() return {'deep'} end})
print(copy.copy(object), copy.deepcopy({object, object})[1][1], copy.deepcopy(5))
print(table.tostring({1, {2}, a = 'x'}, '; '), table.join({1, 'a'}, '-'))
-- those that are global, or parts of the standard libraries
print(require 'functional', require 'var', require 'stringx', require 'tablex', require 'mathx', require 'checkargs')
for _, names in ipairs{
    [[map reduce filter foreach range identity zip negate apply partial any all iter reify sum prod getvar setvar getlocals f checkargs checkargsEx]],
    [[string.split string.isidentifier table.slice table.fromipairs math.median math.sign operator.add operator.le]],
} do
    for name in names:gmatch('%S+') do
        if type(getvar(name)) ~= 'function' then print('missing', name) end
    end
end
print(reduce(operator.add, {1, 2}), reduce(operator.add, {1, 2}, 5), reduce(math.max, {-1, -2}), sum{1, 2}, sum({1, 2}, 3), prod{2, 3}, prod({2, 3}, 1))
local function checked(...)
    local x, text = checkargs({{type = 'float'}, {type = 'string', default = 'x'}}, ...)
    return x, text
end
print(checked(1), pcall(checked), pcall(checked, 'a'))
print(select('#', table.extend({}, {1})), table.frompairs{{'a', 1}}, table.frompairs(pairs{b = 2}), ('a b'):isprintable(), ('a\0'):isprintable(), ('ab1'):islower(), ('aB'):islower(), ('A1'):isupper(), ('Ab'):isupper())

-- variables by name
own = {list = {1, {name = 'inner'}}, ['a b'] = 2}
setvar('own.list[3]', 'third')
setvar('own.new.deep[2]', true)
print(getvar('own.list[2].name'), getvar("own['a b']"), getvar('own.list[3]'), own.new.deep[2], getvar('own.none.x') == nil, getvar('list[1]', own))
local first = getlocals(1)
print(first.own, type(first.copy), type(getlocals(1).first))
local n, none = 2.5, nil
local text = f 'n is {n} {n=} {n:.2f} {own.list[1]} {none}'
print(text, none)

-- import
print(type(import 'itertools'), type(itertools))
import('itertools', 'product', 'chain')
import 'dkjson.*'
import 'simEigen.*'
print(Matrix, Vector, Quaternion, Pose)
print(type(product), type(chain), type(encode), pcall(import, 'itertools', 'nothing'))
