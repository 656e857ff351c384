"""Names of the simulator's modules that a Python text uses, a line for each: kind, line, module, member, whether it is called."""
import ast
import sys


def required(node):
    """The module of `require('module')`, with whatever stands before the dot."""
    if not isinstance(node, ast.Call) or len(node.args) != 1:
        return None
    name = getattr(node.func, 'attr', getattr(node.func, 'id', None))
    argument = node.args[0]
    is_text = isinstance(argument, ast.Constant) and isinstance(argument.value, str)
    return argument.value if name == 'require' and is_text else None


def main():
    try:
        tree = ast.parse(sys.stdin.buffer.read())
    except (SyntaxError, ValueError) as error:
        return print('error', getattr(error, 'lineno', None) or 1, error.args[0], '', '', sep='\t')
    nodes = list(ast.walk(tree))
    modules, called, own = {}, set(), set()
    for node in nodes:
        if isinstance(node, ast.Assign) and required(node.value):
            for target in node.targets:
                if isinstance(target, ast.Name):
                    modules[target.id] = required(node.value)
        if isinstance(node, ast.Call):
            called.add(node.func)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and not isinstance(node.ctx, ast.Load):
            own.add((node.value.id, node.attr))
    found = []
    for node in nodes:
        if required(node):
            found.append((node.lineno, 'module', required(node), '', ''))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            name = node.value.id
            if (name, node.attr) not in own:
                found.append((node.lineno, 'member', modules.get(name, name), node.attr, 'call' if node in called else ''))
    for line, kind, module, member, call in sorted(found):
        print(kind, line, module, member, call, sep='\t')


main()
