-- What is tested does not see the vocabulary of tests.
describe('a module', function()
    it('has Lua\'s own assert', function()
        assert.are.equal('function', load('return type(assert)')())
        assert.has_error(load("assert(false, 'the message')"), 'the message')
        assert.has_error(load("error({code = 3})"), {code = 3})
    end)

    it('has none of the names of tests', function()
        for _, name in ipairs{'describe', 'it', 'pending', 'before_each', 'spy', 'stub', 'mock', 'match'} do
            assert.is_nil(load('return ' .. name)())
        end
    end)

    it('sees what a test says is global', function()
        _G.saidGlobal = 5
        assert.are.equal(5, load('return saidGlobal')())
        _G.saidGlobal = nil
    end)
end)

describe('stubs', function()
    local t = {f = function() return 'original' end, g = function() return 'original' end}

    setup(function() stub(t, 'f').returns('stub') end)
    teardown(function() t.f:revert() end)

    it('of a setup are there in a first test', function() assert.are.equal('stub', t.f()) end)
    it('and in a second one', function()
        assert.are.equal('stub', t.f())
        stub(t, 'g')
    end)
    it('stay until they are reverted', function()
        assert.is_nil(t.g())
        t.g:revert()
    end)
end)
