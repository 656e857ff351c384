-- topic: globals
-- as: customization
-- passes: 0
-- note: what every script costs before it does anything; scenes have thousands of them
-- 38 and 40 kB when this was written; the runner of tests adds 6 to count lines.
local before = collectgarbage('count')
collectgarbage()
local kilobytes = collectgarbage('count')
print(kilobytes < 46 and 'small' or kilobytes, before < 50 and 'small' or before)
