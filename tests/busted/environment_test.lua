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
