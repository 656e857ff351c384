--[[
Classes with single inheritance, class methods, mixins and inherited metamethods; the interface of the library of that name.

    class(name, super)                            a new class; super is optional
    Class(...), Class:new(...)                    an instance; calls initialize(self, ...)
    Class:allocate()                              an instance that is not initialized
    Class:subclass(name)                          a subclass; calls Class.static.subclassed(Class, other) first
    Class:include(mixin, ...)                     copies the methods of tables; calls mixin:included(Class)
    Class:isSubclassOf(other), object:isInstanceOf(Class)
    Class.name, Class.super, Class.static, Class.subclasses, object.class
]]

local getmetatable, setmetatable, rawget, type, pairs = getmetatable, setmetatable, rawget, type, pairs

-- An __index of the class itself is asked after the methods.
local function indexThrough(methods, own)
    if own == nil then return methods end
    local isFunction = type(own) == 'function'
    return function(object, name)
        local method = methods[name]
        if method ~= nil then return method end
        if isFunction then return own(object, name) end
        return own[name]
    end
end

-- Gives a method to a class and to those subclasses that have none of their own.
local function spread(class, name, method)
    local value = method
    if name == '__index' then value = indexThrough(class.__instanceDict, method) end
    class.__instanceDict[name] = value
    for subclass in pairs(class.subclasses) do
        if rawget(subclass.__declaredMethods, name) == nil then spread(subclass, name, method) end
    end
end

local function declare(class, name, method)
    class.__declaredMethods[name] = method
    if method == nil and class.super then method = class.super.__instanceDict[name] end
    spread(class, name, method)
end

local classMeta = {
    __index = function(class, name) return rawget(class, 'static')[name] end,
    __newindex = declare,
    __call = function(class, ...) return class:new(...) end,
    __tostring = function(class) return 'class ' .. class.name end,
}

local function createClass(name, super)
    local methods = {}
    methods.__index = methods
    local class = {
        name = name, super = super, static = {}, __instanceDict = methods, __declaredMethods = {},
        subclasses = setmetatable({}, {__mode = 'k'}),
    }
    -- Class methods: of the class, of its ancestors, and its instance methods too.
    setmetatable(class.static, {__index = function(_, key)
        local value = rawget(methods, key)
        if value == nil and super then return super.static[key] end
        return value
    end})
    return setmetatable(class, classMeta)
end

local function includeMixin(class, mixin)
    assert(type(mixin) == 'table', 'mixin must be a table')
    for name, method in pairs(mixin) do
        if name ~= 'included' and name ~= 'static' then class[name] = method end
    end
    for name, method in pairs(mixin.static or {}) do class.static[name] = method end
    if type(mixin.included) == 'function' then mixin:included(class) end
    return class
end

local Root = {
    static = {},
    __tostring = function(object) return 'instance of ' .. tostring(object.class) end,
    initialize = function() end,
}

function Root.isInstanceOf(object, class)
    return type(class) == 'table' and type(object) == 'table'
        and (object.class == class or type(object.class) == 'table' and type(object.class.isSubclassOf) == 'function'
            and object.class:isSubclassOf(class))
end

local function expectClass(class, method)
    assert(type(class) == 'table', ("Make sure that you are using 'Class:%s' instead of 'Class.%s'"):format(method, method))
end

function Root.static.allocate(class)
    expectClass(class, 'allocate')
    return setmetatable({class = class}, class.__instanceDict)
end

function Root.static.new(class, ...)
    expectClass(class, 'new')
    local object = class:allocate()
    object:initialize(...)
    return object
end

function Root.static.subclass(class, name)
    expectClass(class, 'subclass')
    assert(type(name) == 'string', 'You must provide a name(string) for your class')
    local subclass = createClass(name, class)
    for key, method in pairs(class.__instanceDict) do
        if key ~= '__index' or type(method) ~= 'table' then spread(subclass, key, method) end
    end
    subclass.initialize = function(object, ...) return class.initialize(object, ...) end
    class.subclasses[subclass] = true
    class:subclassed(subclass)
    return subclass
end

function Root.static.subclassed() end

function Root.static.isSubclassOf(class, other)
    return type(other) == 'table' and type(class.super) == 'table' and (class.super == other or class.super:isSubclassOf(other))
end

function Root.static.include(class, ...)
    expectClass(class, 'include')
    for _, mixin in ipairs{...} do includeMixin(class, mixin) end
    return class
end

local middleclass = {_VERSION = 'middleclass v4.1.1'}

function middleclass.class(name, super)
    assert(type(name) == 'string', 'A name (string) is needed for the new class')
    return super and super:subclass(name) or includeMixin(createClass(name), Root)
end

-- @api table class = middleclass.class(string name, table super = nil)

return setmetatable(middleclass, {__call = function(_, ...) return middleclass.class(...) end})
