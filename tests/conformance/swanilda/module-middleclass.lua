-- topic: modules
-- as: sandbox
-- passes: 0
-- note: classes
local class = require 'middleclass'
local Animal = class('Animal')
Animal.static.count = 0
function Animal.static.create(klass, ...) return klass:new(...) end
function Animal:initialize(name)
    self.name = name
    Animal.static.count = Animal.count + 1
end
function Animal:speak() return self.name .. ' speaks' end
function Animal:__tostring() return 'animal ' .. self.name end
function Animal.__eq(a, b) return a.name == b.name end
function Animal:__len() return #self.name end
local Dog = class('Dog', Animal)
function Dog:speak() return Animal.speak(self) .. ' loudly' end
local Puppy = Dog:subclass('Puppy')
local a, d, p = Animal('ann'), Dog:new('rex'), Puppy:create('bo')
print(a:speak(), d:speak(), p:speak())
print(tostring(a), tostring(p), #d, Dog('rex') == d, Animal.count, Puppy.count)
print(p:isInstanceOf(Animal), a:isInstanceOf(Dog), Puppy:isSubclassOf(Animal), Animal:isSubclassOf(Puppy), p.class == Puppy)
print(tostring(Dog), Dog.name, Dog.super == Animal, Animal.super, Animal.subclasses[Dog], Animal.subclasses[Puppy])
function Animal:late() return 'late' end
print(p:late())
Dog.late = function() return 'dog' end
print(p:late())
Dog.late = nil
print(p:late())
local Flying = {fly = function(self) return self.name .. ' flies' end, static = {wings = 2}}
function Flying:included(klass) print('included in ' .. klass.name) end
Dog:include(Flying)
print(p:fly(), Dog.wings, Puppy.wings, a.fly, Dog.included)
function Animal.__index(_, key) return 'no ' .. key end
print(a.missing, p.missing, p:speak())
local Hooked = class('Hooked')
function Hooked.static.subclassed(klass, other) print(klass.name, 'got', other.name) end
local Sub = class('Sub', Hooked)
print(tostring(Sub()), Sub:allocate().class == Sub, pcall(class))
print(require 'class' == class, pcall(Dog.new))
