-- topic: helpers
-- as: sandbox
-- passes: 0
-- spec: scripts 9
-- note: string helpers
print(string.split('a,b,,c', ','), ('a b  c'):split(' '), string.split('abc', ','), string.split('', ','))
print(('a.b.c'):split('.', true), ('a1b22c'):split('%d+'))
print(('hello'):startswith 'he', ('hello'):startswith 'lo', ('hello'):endswith 'lo', ('hello'):endswith 'he', ('x'):startswith '')
print('[' .. ('  a b '):trim() .. ']', '[' .. ('  a'):ltrim() .. ']', '[' .. ('a  '):rtrim() .. ']')
print(('ab'):chars(), ('ab'):bytes())
print(('a.b*c'):escpat())
print(('abc1'):isalnum(), ('abc'):isalpha(), ('_a1'):isidentifier(), ('1a'):isidentifier(), ('12'):isnumeric(), ('a b'):isalnum(), ('  '):isspace(), ('AB'):isupper(), ('ab'):islower())
print(('hello'):capitalize(), ('it\'s'):escapequotes(), ('<a&b>'):escapehtml())
print(('prefix-rest'):stripprefix('prefix-'), ('prefix-rest'):stripprefix('zz'))
print('[' .. ('ab'):pad(5) .. ']', '[' .. ('ab'):pad(-5) .. ']')
