--[[
Extensions of the string library: splitting, trimming, classes of characters, blocks of text.

They are functions of `string`, and methods of texts, from the start. This module is there for scripts that require it: it returns nothing.
]]
