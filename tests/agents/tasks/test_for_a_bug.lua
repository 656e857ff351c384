-- A test that fails for what is wrong, and passes for what is right.
local WRONG = [[
local function clamp(x, low, high)
    if x < low then return low end
    if x > high then return low end
    return x
end
]]
local RIGHT = WRONG:gsub('high then return low', 'high then return high')

return {
    task = 'The function clamp(x, low, high) has a bug. Write tests that fail because of it, and pass when it is repaired:\n' .. WRONG,
    solve = function(call)
        local tests = [[
describe('clamp', function()
    it('leaves what is between', function() assert.are.equal(2, clamp(2, 1, 3)) end)
    it('raises what is too low', function() assert.are.equal(1, clamp(0, 1, 3)) end)
    it('lowers what is too high', function() assert.are.equal(3, clamp(9, 1, 3)) end)
end)
]]
        local result = call('run_tests', {code = WRONG .. tests})
        assert(result.text:find('2 passed, 1 failed') and result.text:find('lowers what is too high'), result.text)
        return tests
    end,
    check = function(call, answer)
        if not answer then return 'there is no answer' end
        local function failures(code)
            local bad = 0
            for _, test in ipairs(call('run_tests', {code = code .. answer}).values.tests) do
                if test.status ~= 'passed' then bad = bad + 1 end
            end
            return bad
        end
        if failures(WRONG) == 0 then return 'the tests pass in spite of the bug' end
        if failures(RIGHT) > 0 then return 'the tests fail without the bug' end
    end,
}
