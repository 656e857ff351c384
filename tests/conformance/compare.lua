--[[
Comparing output with a recording: the rules of the READMEs below, as crates/test-support/src/compare.rs has them.
]]

local M = {}

-- What the original adds to the notice of a deprecated function: the name of a file that is not read here.
local SETTINGS_REMARK = ' %(control verbosity via notifyDeprecated in usrset%.txt%)$'

local function isLog(line, levels)
    local level = line:match('^%[[^%]]*:(%a+)%]')
    return levels[level or ''] ~= nil
end

--- Drops what is not a script's output; `isScene`: all warnings and infos as well. Positions in the case `name` have its file, however it was
--- loaded.
function M.normalized(output, folder, name, isScene)
    local lines = {}
    local chunk = '%[string "' .. name:gsub('%p', '%%%0') .. '"%]:'
    for line in (output:gsub('\n$', '') .. '\n'):gmatch('(.-)\r?\n') do
        local isChatter = line:find(':loadinfo]', 1, true)
            or line:find('^%[sandboxScript:info%]')
            or isScene and isLog(line, { warning = true, info = true })
            or line == 'stack traceback:'
            or line:find('^\t')
        if not isChatter then
            line = line:gsub('0x%x%x%x%x%x%x+', '0xADDR'):gsub(chunk, name .. '.lua:')
            local first, last = line:find(folder, 1, true)
            while first do
                line = line:sub(1, first - 1) .. line:sub(last + 1)
                first, last = line:find(folder, first, true)
            end
            lines[#lines + 1] = line
        end
    end
    return table.concat(lines, '\n')
end

-- The number `text` begins with at `place`, and where it ends.
local function numberAt(text, place)
    local sign = text:match('^[-+]?', place)
    local word = text:match('^nan', place + #sign) or text:match('^inf', place + #sign)
    local number = word and sign .. word
        or text:match('^[-+]?%d+%.?%d*', place)
        or text:match('^[-+]?%.%d+', place)
    if not number then return end
    if not word then number = number .. (text:match('^[eE][-+]?%d+', place + #number) or '') end
    if text:find('^[%a_]', place + #number) then return end
    local value = word == 'nan' and 0 / 0 or word and (sign == '-' and -math.huge or math.huge) or tonumber(number)
    return value, place + #number
end

-- The text with every number replaced by `#`, and the numbers.
local function split(line)
    local text, numbers, place, previous = {}, {}, 1, ' '
    while place <= #line do
        local number, next
        if not previous:find('[%a_]') then number, next = numberAt(line, place) end
        if number then
            text[#text + 1], numbers[#numbers + 1] = '#', number
            previous, place = '0', next
        else
            previous = line:sub(place, place)
            text[#text + 1] = previous
            place = place + 1
        end
    end
    return table.concat(text), numbers
end

local function agree(want, got, tolerance)
    if want == got then return true end
    local wantText, wantNumbers = split(want)
    local gotText, gotNumbers = split(got)
    if wantText ~= gotText then return false end
    for i, a in ipairs(wantNumbers) do
        local b = gotNumbers[i]
        if not (math.abs(a - b) <= tolerance + 1e-12 or a == b or a ~= a and b ~= b) then return false end
    end
    return true
end

local function linesOf(text)
    local lines = {}
    for line in (text:gsub('\n+$', '') .. '\n'):gmatch('(.-)\n') do lines[#lines + 1] = (line:gsub('%s+$', ''):gsub(SETTINGS_REMARK, '')) end
    return lines
end

--- The first lines that differ, or nil when all agree within `tolerance`.
function M.difference(expected, actual, tolerance)
    local want, got, report = linesOf(expected), linesOf(actual), {}
    for i = 1, math.max(#want, #got) do
        if not (want[i] and got[i] and agree(want[i], got[i], tolerance)) then
            report[#report + 1] =
                ('line %d:\n  expected %s\n  actual   %s'):format(i, want[i] or '(nothing)', got[i] or '(nothing)')
        end
        if #report == 8 then break end
    end
    return report[1] and table.concat(report, '\n')
end

return M
