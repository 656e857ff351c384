-- topic: globals
-- as: customization
-- passes: 0
-- note: what every script costs before it does anything; scenes have thousands of them
local before = collectgarbage('count')
collectgarbage()
local kilobytes = collectgarbage('count')
print(kilobytes < 42 and 'small' or kilobytes, before < 46 and 'small' or before)
