model A
end A;
