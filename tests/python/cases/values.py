#luaExec function echo(...) return ... end
#luaExec function types(...) local t = {}; for i = 1, select('#', ...) do local v = select(i, ...); t[i] = isbuffer(v) and 'buffer' or math.type(v) or type(v) end; return t end
import enum


class Color(enum.IntEnum):
    RED = 3


class Name(str):
    pass


def sysCall_init():
    sim = require('sim')

    def lua(name, *args):
        return sim.callScriptFunction(name + '@lua', sim.handle_self, *args)

    print(lua('types', None, 1, 1.0, 'a', b'b', [], {}, [1, None, 3], True, 1 << 40))
    print(lua('echo', 1, 'a'), lua('echo'), lua('echo', None))
    print(repr(lua('echo', 1.0)), repr(lua('echo', 1)), repr(lua('echo', -(1 << 62))))
    print(lua('echo', b'\0x'), lua('echo', 'ü'), lua('echo', [1, [2, {'a': 'b'}]]))
    print(lua('echo', []), lua('echo', {'a': []}), lua('echo', {1: 'x', 2: 'y'}))
    print(lua('echo', (1, 2)), lua('echo', Color.RED), lua('echo', Name('n')), lua('echo', bytearray(b'z')))
    print(lua('echo', float('inf')), lua('echo', 1 << 70), lua('types', 1 << 70))
    print(sim.packDoubleTable([1.5]), sim.unpackDoubleTable(sim.packDoubleTable([1.5])))
    for value in (object, object()):
        try:
            print(str(lua('echo', [[[[value]]]]))[:20])
        except Exception as error:
            print(type(error).__name__)
