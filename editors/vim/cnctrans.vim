" Vim 9 with yegappan/lsp, or Neovim 0.11: `cnctrans lsp` for part programs. Put it into ~/.vim/plugin or ~/.config/nvim/plugin.
augroup cnctrans_types
  autocmd!
  autocmd BufRead,BufNewFile *.pim,*.pit setfiletype fagor
  autocmd BufRead,BufNewFile *.xpi setfiletype num
  autocmd BufRead,BufNewFile *.mpf,*.spf,*.MPF,*.SPF setfiletype sinumerik
  autocmd BufRead,BufNewFile *.H if getline(1) =~? 'BEGIN PGM' | setlocal filetype=heidenhain | endif
  autocmd FileType fagor,sinumerik,heidenhain setlocal commentstring=;\ %s
  autocmd FileType num setlocal commentstring=(%s)
augroup END

let s:types = ['fagor', 'num', 'sinumerik', 'heidenhain']
if has('nvim')
  lua vim.lsp.config('cnctrans', { cmd = { 'cnctrans', 'lsp' }, filetypes = { 'fagor', 'num', 'sinumerik', 'heidenhain' } })
  lua vim.lsp.enable('cnctrans')
elseif exists('*LspAddServer')
  call LspAddServer([#{name: 'cnctrans', filetype: s:types, path: 'cnctrans', args: ['lsp']}])
else
  autocmd User LspSetup call LspAddServer([#{name: 'cnctrans', filetype: s:types, path: 'cnctrans', args: ['lsp']}])
endif
