-- topic: modules
-- as: sandbox
-- passes: 0
-- note: every function the reference names is there, and the modules' own tests
local wanted = {
    stringx = [[qsplit gsplit split startswith endswith trim ltrim rtrim chars bytes escpat isalnum isalpha isidentifier islower isnumeric
        isprintable isspace isupper capitalize escapequotes escapehtml stripmarkdown renderxml stripprefix stripsuffix elide utf8sub _len pad
        blocksize blockpad blockhstack unittest]],
    tablex = [[unpackx index eq keys filter invert isarray join tostring slice print find compare reversed sorted clone deepcopy add extend rep
        batched flatten collapse unflatten update items frompairs fromipairs getn setn unittest]],
    mathx = [[random2 randomseed2 median atan2 cosh frexp hypot ldexp log10 mod pow sign sinh tanh]],
    functional = [[range map reduce filter foreach identity zip negate apply partial any all iter reify sum prod operator unittest]],
    var = 'getvar setvar getlocals f unittest', copy = 'copy deepcopy unittest',
    checkargs = 'checkarg getdefault checkargsEx checkargs unittest',
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
